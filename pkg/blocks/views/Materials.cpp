// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/views/BlockMat.hpp>
#include <blocks/views/Materials.hpp>
#include <core/Omega.hpp>

namespace yade {

blocks::Material materialOf(const BlockModel& model, const std::string& label)
{
	const auto known = std::find(model.materialLabels.begin(), model.materialLabels.end(), label);
	if (known != model.materialLabels.end()) return model.assembly.mesh.materials[known - model.materialLabels.begin()];

	for (const auto& material : Omega::instance().getScene()->materials)
		if (material->label == label) {
			const auto* mat = dynamic_cast<const BlockMat*>(material.get());
			if (!mat) throw std::invalid_argument("material \"" + label + "\" must be a BlockMat, got " + material->getClassName());
			return { mat->young, mat->poisson, mat->density };
		}
	throw std::invalid_argument("no material labelled \"" + label + "\" in O.materials: append a BlockMat(label=\"" + label + "\", ...) first");
}

int BlockModel::materialIndex(const std::string& label)
{
	const auto known = std::find(materialLabels.begin(), materialLabels.end(), label);
	if (known != materialLabels.end()) return int(known - materialLabels.begin());
	const int index = assembly.addMaterial(materialOf(*this, label));
	materialLabels.push_back(label);
	return index;
}

} // namespace yade
