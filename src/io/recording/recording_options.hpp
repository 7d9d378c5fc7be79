#pragma once

#include "core/text/option.hpp"
#include "io/recording/recording.hpp"

namespace corpuscle {

/// The options for reading a recording, except --rate, which means something different in each verb.
OptionGroup recording_option_group(RecordingOptions&);

/// These options with --rate, for programs that name them.
OptionGroup named_recording_options(RecordingOptions&);

}  // namespace corpuscle
