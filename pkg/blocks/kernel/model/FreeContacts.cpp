// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/EdgeShapes.hpp>
#include <numeric>
#include <utility>

namespace blocks {
void sortContacts(BlockAssembly& a)
{
	FreeContacts& f      = a.contacts;
	const auto&   all    = a.state.contacts.all(); // a new edition: columns that know the old order are used no more
	const int     blocks = a.blockCount();
	const auto    count  = [&](std::vector<int>& first, int sides) { // the contacts of block b begin at first[b]
                first.assign(blocks + 1, 0);
                for (const FreeContact& c : all)
                        for (int side = 0; side < sides && c.block[0] >= 0; ++side)
                                ++first[c.block[side] + 1];
                std::partial_sum(first.begin(), first.end(), first.begin());
	};
	std::vector<int> firstOfFirst; // block -> its contacts with later ones
	count(firstOfFirst, 1);
	std::vector<int> next = firstOfFirst;
	f.order.resize(firstOfFirst.back());
	for (int i = 0; i < int(all.size()); ++i)
		if (all[i].block[0] >= 0) f.order[next[all[i].block[0]]++] = i;
	for (int b = 0; b < blocks; ++b)
		std::sort(f.order.begin() + firstOfFirst[b], f.order.begin() + firstOfFirst[b + 1], [&](int i, int j) {
			return all[i].block[1] < all[j].block[1];
		});
	f.sleep.clear();
	for (int i : f.order)
		f.sleep.push_back({ all[i].block });
	f.ofBlock.assign(2 * f.order.size(), 0);
	count(f.firstOfBlock, 2);
	if (f.order.empty()) f.firstOfBlock.clear();
	next = f.firstOfBlock;
	f.rangeOf.resize(all.size());
	for (int i : f.order) // sorted by both blocks: every block meets the others in their order
		for (int side : { 0, 1 }) {
			int& place         = next[all[i].block[side]];
			f.ofBlock[place]   = i;
			f.rangeOf[i][side] = place++;
		}
	f.blocksInContact.clear();
	for (int b = 0; b + 1 < int(f.firstOfBlock.size()); ++b)
		if (f.firstOfBlock[b] != f.firstOfBlock[b + 1]) f.blocksInContact.push_back(b);
}

void makeContacts(BlockAssembly& a, const std::vector<std::array<int, 2>>& wanted)
{
	std::vector<FreeContact>& all  = a.state.contacts.all();
	size_t                    slot = 0, made = 0;
	for (size_t i = 0; i < wanted.size(); ++i) {
		const auto& blocks = wanted[i];
		if ((i > 0 && wanted[i - 1] == blocks) || contactOf(a, blocks[0], blocks[1]) >= 0) continue;
		while (slot < all.size() && all[slot].block[0] >= 0)
			++slot;
		if (slot == all.size()) all.emplace_back();
		all[slot]       = {};
		all[slot].block = blocks;
		const int kind  = a.joints.kindOfMaterials(a.mesh.blockMaterial[blocks[0]], a.mesh.blockMaterial[blocks[1]]);
		if (kind > 0) all[slot].joint = a.joints.kinds[kind];
		++made;
	}
	if (made > 0) sortContacts(a);
}

int contactOf(const BlockAssembly& a, int block1, int block2)
{
	const FreeContacts& f   = a.contacts;
	const auto          key = ordered(block1, block2);
	if (key[0] + 1 >= int(f.firstOfBlock.size())) return -1;
	for (int i = f.firstOfBlock[key[0]]; i < f.firstOfBlock[key[0] + 1]; ++i)
		if (a.state.contacts[f.ofBlock[i]].block == key) return f.ofBlock[i];
	return -1;
}

void forgetActive(FreeContact& contact)
{
	contact.rests.assign(contact.edges.size(), {});
	contact.active.clear();
	contact.active.reserve(contact.edges.size()); // nothing is allocated inside a step
}

void placeForces(BlockAssembly& a)
{
	FreeContacts& f    = a.contacts;
	int           room = 0;
	for (Sleep& s : f.sleep)
		s.until = 0;
	f.range.resize(f.ofBlock.size());
	const auto& all = std::as_const(a.state.contacts);
	for (size_t i = 0; i < f.ofBlock.size(); ++i) {
		f.range[i] = { room, room };
		room += int(all[f.ofBlock[i]].edges.size());
	}
	f.forces.resize(room);
}

void followEdition(BlockAssembly& a)
{
	FreeContacts& f = a.contacts;
	if (f.columnsOf == a.state.contacts.edition()) return;
	f.columnsOf        = a.state.contacts.edition();
	const int contacts = int(f.order.size());
	f.inWork.resize((contacts + FreeContacts::run - 1) / FreeContacts::run);
	for (int first = 0; first < contacts; first += FreeContacts::run) {
		size_t pairs = 0;
		for (int place = first; place < std::min(contacts, first + FreeContacts::run); ++place) {
			FreeContact& c       = a.state.contacts.keepingEdition(f.order[place]);
			f.sleep[place].pairs = int(c.edges.size()), f.sleep[place].rests = c.rests.data();
			pairs += c.edges.size();
		}
		f.inWork[first / FreeContacts::run].startAnew(pairs);
	}
}

void rebuildContacts(BlockAssembly& a)
{
	a.contacts.started = false;
	if (!a.contacts.wanted && a.state.contacts.empty() && a.state.search.lookedAt.empty()) return; // there may be none yet
	a.contacts.wanted = true;
	computeShapes(a);
	a.contacts.corners = cornersOf(a);
	sortContacts(a);
	for (FreeContact& c : a.state.contacts) {
		for (EdgePair& e : c.edges)
			nameEdges(a, e);
		forgetActive(c);
	}
	placeForces(a);
	++a.contacts.version; // whoever shows them, or had asked for their properties, has those of another state
}

} // namespace blocks
