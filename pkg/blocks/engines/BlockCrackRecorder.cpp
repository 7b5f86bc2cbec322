// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockCrackRecorder.hpp>
#include <blocks/kernel/step/Joints.hpp>
#include <cerrno>
#include <core/Omega.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace yade {

BlockCrackRecorder::~BlockCrackRecorder() = default;

namespace {
	bool isCrack(int status) { return status == int(blocks::Joint::brokenInTension) || status == int(blocks::Joint::brokenInShear); }

	const char* nameOf(int mode) { return mode == int(blocks::Joint::brokenInTension) ? "tension" : "shear"; }

	/// Adds lines to a file, all of them or none: where they do not fit, the file keeps the whole lines that it had.
	void addLines(const string& path, const string& lines, std::ios::openmode mode)
	{
		std::error_code none;
		const auto      size   = std::filesystem::file_size(path, none);
		const auto      before = none || mode == std::ios::trunc ? 0 : size;
		errno                  = 0;
		std::ofstream file(path, mode);
		file << lines;
		file.close(); // what the disk has no room for is noticed here
		if (file) return;
		const string reason = errno ? std::strerror(errno) : "no reason given";
		std::filesystem::resize_file(path, before, none);
		throw std::runtime_error("BlockCrackRecorder.fileName: cannot write to " + path + ": " + reason);
	}

	/// A joint's name as a column of a file: quoted where it would be several, - where there is none.
	string columnOf(const string& name)
	{
		if (name.empty()) return "-";
		if (name.find_first_of(" \t\n\"") == string::npos) return name;
		std::ostringstream quoted;
		quoted << std::quoted(name);
		return quoted.str();
	}

}

void BlockCrackRecorder::action()
{
	onModel(scene, [&](const BlockModel& model) { look(model); });
}

void BlockCrackRecorder::look(const BlockModel& model)
{
	const blocks::BlockAssembly& a = model.assembly;
	if (known.size() != a.state.status.size()) { // the first look: what is broken already is no event
		known.clear();
		for (blocks::Joint status : a.state.status)
			known.push_back(int(status));
		if (!fileName.empty()) addLines(fileName, "step time x y nx ny mode body1 body2 material1 material2 damage name\n", std::ios::trunc);
	}
	bool takenBack = false; // a rescued state is older than what was seen: there are joints that are whole again
	for (size_t i = 0; i < known.size() && !takenBack; ++i)
		takenBack = isCrack(known[i]) && !isCrack(int(a.state.status[i]));
	if (takenBack) {
		size_t kept = 0;
		for (size_t e = 0; e < points.size(); ++e) {
			if (!isCrack(int(a.state.status[points[e]]))) continue;
			points[kept] = points[e], modes[kept] = modes[e], steps[kept] = steps[e], times[kept] = times[e], positions[kept] = positions[e];
			damages[kept] = damages[e];
			++kept;
		}
		points.resize(kept), modes.resize(kept), steps.resize(kept), times.resize(kept), positions.resize(kept), damages.resize(kept);
	}
	const size_t before = points.size();
	for (size_t i = 0; i < a.state.status.size(); ++i) {
		const int status = int(a.state.status[i]);
		if (status == known[i]) continue;
		const bool earlier = isCrack(known[i]); // a crack stays one, but for a rescue
		known[i]           = status;
		if (earlier || !isCrack(status)) continue;
		points.push_back(int(i));
		modes.push_back(status);
		steps.push_back(scene->iter);
		times.push_back(scene->time);
		positions.push_back(blocks::contactPosition(a, int(i)));
		damages.push_back(blocks::damageOf(a, int(i)));
	}
	if (fileName.empty() || points.size() == before) return;
	std::ostringstream file;
	file.imbue(std::locale::classic());
	file.precision(9);
	for (size_t e = before; e < points.size(); ++e) {
		const auto& g     = a.joints.segments[points[e] / 2];
		const auto  frame = blocks::frameOf(a, points[e] / 2);
		file << steps[e] << ' ' << times[e] << ' ' << positions[e].x() << ' ' << positions[e].y() << ' ' << frame.nx << ' ' << frame.ny << ' '
		     << nameOf(modes[e]) << ' ' << model.firstBody + g.block[0] << ' ' << model.firstBody + g.block[1] << ' ' << model.labelOf(g.block[0])
		     << ' ' << model.labelOf(g.block[1]) << ' ' << damages[e] << ' ' << columnOf(a.joints.called(points[e] / 2)) << '\n';
	}
	addLines(fileName, file.str(), std::ios::app);
}

py::list BlockCrackRecorder::events() const
{
	py::list list;
	if (points.empty()) return list;
	const BlockModel& model = *BlockModel::of(Omega::instance().getScene().get());
	for (size_t e = 0; e < points.size(); ++e) {
		const auto& g = model.assembly.joints.segments[points[e] / 2];
		py::dict    event;
		event["step"]      = steps[e];
		event["time"]      = times[e];
		event["position"]  = positions[e];
		event["mode"]      = nameOf(modes[e]);
		event["point"]     = points[e];
		event["ids"]       = py::make_tuple(model.firstBody + g.block[0], model.firstBody + g.block[1]);
		event["materials"] = py::make_tuple(model.labelOf(g.block[0]), model.labelOf(g.block[1]));
		event["damage"]    = damages[e];
		event["name"]      = model.assembly.joints.called(points[e] / 2);
		list.append(event);
	}
	return list;
}

YADE_PLUGIN((BlockCrackRecorder));

} // namespace yade
