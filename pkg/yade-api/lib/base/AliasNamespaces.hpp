#pragma once

namespace boost {
namespace python {
}
}

namespace yade {
namespace py = ::boost::python;
}
