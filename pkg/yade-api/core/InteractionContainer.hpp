#pragma once

#include <core/BodyContainer.hpp>
#include <core/Interaction.hpp>
#include <lib/serialization/Serializable.hpp>
#include <mutex>

namespace yade {

class InteractionContainer : public Serializable {
	using ContainerT = vector<shared_ptr<Interaction>>;
	ContainerT                       linIntrs;
	ContainerT                       sortedIntrs;
	const BodyContainer::ContainerT* bodies;
	size_t                           currSize;
	shared_ptr<Interaction>          empty;
	ContainerT                       interaction;

public:
	bool       dirty;
	std::mutex drawloopmutex;
	bool       serializeSorted;
	long       iterColliderLastRun;

	virtual ~InteractionContainer();
	YADE_API_IN_LIBRARY

	using iterator       = ContainerT::iterator;
	using const_iterator = ContainerT::const_iterator;
	iterator                       begin() { return linIntrs.begin(); }
	iterator                       end() { return linIntrs.end(); }
	const_iterator                 begin() const { return linIntrs.begin(); }
	const_iterator                 end() const { return linIntrs.end(); }
	size_t                         size() { return currSize; }
	shared_ptr<Interaction>&       operator[](size_t i) { return linIntrs[i]; }
	const shared_ptr<Interaction>& operator[](size_t i) const { return linIntrs[i]; }

	const shared_ptr<Interaction>& find(Body::id_t id1, Body::id_t id2); ///< null if there is none
	bool                           insert(Body::id_t id1, Body::id_t id2);
	bool                           insert(const shared_ptr<Interaction>&);
	bool                           erase(Body::id_t id1, Body::id_t id2, int linPos); ///< linPos must be the interaction's linIx
	void                           eraseNonReal();
	void                           requestErase(Body::id_t id1, Body::id_t id2);
	void                           requestErase(const shared_ptr<Interaction>&);
	void                           requestErase(Interaction*);
	void                           clear();
};
YADE_API_SAVED_IN_LIBRARY(InteractionContainer)

} // namespace yade
