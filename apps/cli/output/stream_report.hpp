#pragma once
// Status line, summary and JSON document of a live stream.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "live/stream_loop.hpp"

namespace corpuscle {

/// The parts of a running or finished stream that the reports read.
struct StreamReportInput {
    const SkinStream& skin;
    const FrameSource& frames;
    const EventSink& sink;
    const EventFormat& format;
    const StreamLoop& loop;
};

/// The summary at the end of a stream.
std::string stream_summary(const StreamReportInput&);
/// The status line during a stream.
std::string stream_status(const StreamReportInput&);
/// The summary as a JSON document.
nlohmann::ordered_json stream_document(const StreamReportInput&);

}  // namespace corpuscle
