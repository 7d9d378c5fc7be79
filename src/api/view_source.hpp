#pragma once

#include <memory>

#include "core/force_source.hpp"
#include "corpuscle/force.hpp"

namespace corpuscle::api {

/// A source that reads a view, which must outlive it. Throws InputError for a force without samples.
std::unique_ptr<ForceSource> make_view_source(const ForceView&);

}  // namespace corpuscle::api
