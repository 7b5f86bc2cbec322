#pragma once

#include <boost/iterator/filter_iterator.hpp>
#include <core/Body.hpp>
#include <lib/serialization/Serializable.hpp>
#include <mutex>

namespace yade {

class BodyContainer : public Serializable {
	using ContainerT = std::vector<shared_ptr<Body>>;
	friend class InteractionContainer;

public:
	ContainerT  body;
	bool        dirty;
	bool        checkedByCollider;
	vector<int> insertedBodies;
	vector<int> erasedBodies;
	vector<int> realBodies;
	bool        useRedirection;
	bool        enableRedirection;
	vector<int> subdomainBodies;
	std::mutex  drawloopmutex;

	/// Iteration skips bodies that were erased; size() and [] count them.
	struct isNonEmptySharedPtr {
		bool operator()(const shared_ptr<Body>& b) const { return bool(b); }
	};
	using iterator = boost::filter_iterator<isNonEmptySharedPtr, ContainerT::iterator>;

	virtual ~BodyContainer();
	YADE_API_IN_LIBRARY
	iterator                begin();
	iterator                end();
	size_t                  size() const;
	shared_ptr<Body>&       operator[](unsigned int id);
	const shared_ptr<Body>& operator[](unsigned int id) const;
	bool                    exists(Body::id_t id) const;
	Body::id_t              insert(shared_ptr<Body>);
	bool                    erase(Body::id_t id, bool eraseClumpMembers);
};
YADE_API_SAVED_IN_LIBRARY(BodyContainer)

} // namespace yade
