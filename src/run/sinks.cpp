// The list of all output formats of a run. To add one, write its file in run/sinks/ and add its name to the two lists below.

#include "run/sinks.hpp"

namespace corpuscle {

extern const OutputFormat spikes_format, events_format, copies_format, afferents_format, npz_format, sound_format, probes_format,
    vectors_format, trials_format, nwb_format;

namespace {

constexpr const OutputFormat* all_formats[] = {&spikes_format,  &events_format, &copies_format, &afferents_format,
                                               &npz_format,     &psth_format,   &sound_format,  &probes_format,
                                               &vectors_format, &trials_format, &nwb_format};

}  // namespace

constinit const std::span<const OutputFormat* const> output_formats = all_formats;

}  // namespace corpuscle
