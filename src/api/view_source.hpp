#pragma once
// Between forces of the public interface and sources of force.

#include <memory>

#include "core/force_source.hpp"
#include "corpuscle/force.hpp"
#include "io/recording/recording_options.hpp"

namespace corpuscle::api {

/// A source that reads a view, which must outlive it. Throws InputError for a force without samples.
std::unique_ptr<ForceSource> make_view_source(const ForceView&);
/// Reads a source to its end. `has_unit`: the unit of a recording was given.
Force read_force(ForceSource&, bool has_unit = false);
/// The options for reading a recording. Throws InputError.
RecordingOptions recording_options(const Options&);

}  // namespace corpuscle::api
