#pragma once

#include <boost/date_time/posix_time/ptime.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Cell.hpp>
#include <core/EnergyTracker.hpp>
#include <core/Engine.hpp>
#include <core/ForceContainer.hpp>
#include <core/InteractionContainer.hpp>
#include <core/Material.hpp>

namespace yade {

class OpenGLRenderer;
class DisplayParameters;

class Scene : public Serializable {
	const unsigned int hostNameMax;

public:
	ForceContainer                        forces;
	Eigen::Matrix<Real, 10, 1>            SpeedElements;
	shared_ptr<OpenGLRenderer>            renderer;
	boost::posix_time::ptime              prevTime;
	Real                                  dt; ///< [s]
	long                                  iter;
	bool                                  subStepping;
	int                                   subStep;
	Real                                  time; ///< [s]
	Real                                  speed;
	long                                  stopAtIter;
	Real                                  stopAtTime; ///< [s]
	bool                                  isPeriodic;
	bool                                  trackEnergy;
	bool                                  doSort;
	bool                                  runInternalConsistencyChecks;
	Body::id_t                            selectedBody;
	int                                   subdomain;
	shared_ptr<Shape>                     subD;
	vector<string>                        tags; ///< "name=value"
	vector<shared_ptr<Engine>>            engines;
	vector<shared_ptr<Engine>>            _nextEngines;
	shared_ptr<BodyContainer>             bodies;
	shared_ptr<InteractionContainer>      interactions;
	shared_ptr<EnergyTracker>             energy;
	vector<shared_ptr<Material>>          materials;
	shared_ptr<Bound>                     bound;
	shared_ptr<Cell>                      cell;
	vector<shared_ptr<Serializable>>      miscParams;
	vector<shared_ptr<DisplayParameters>> dispParams;

	Scene();
	virtual ~Scene();
	YADE_API_IN_LIBRARY
	shared_ptr<Engine> engineByName(const string& className);
};
YADE_API_SAVED_IN_LIBRARY(Scene)

} // namespace yade
