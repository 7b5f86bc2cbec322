#pragma once

#include <core/Engine.hpp>
#include <core/Functor.hpp>
#include <core/Omega.hpp>
