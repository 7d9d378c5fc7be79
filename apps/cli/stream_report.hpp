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

std::string stream_summary(const StreamReportInput&);
/// One line for a terminal.
std::string stream_status(const StreamReportInput&);
nlohmann::ordered_json stream_document(const StreamReportInput&);

}  // namespace corpuscle
