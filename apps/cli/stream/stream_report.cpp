// Status line, summary and JSON document of a live stream.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/stream/page/stream_page.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

/// A time in ns as text, such as "12.5 us".
std::string time_of(std::int64_t ns) { return format_quantity(static_cast<double>(ns) * 1e-9, "s"); }

/// A number with its noun: "3 gaps", "1 gap".
std::string count_of(std::int64_t n, std::string_view noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

std::string quantiles(const LatencyHistogram& histogram) {
    return fmt::format("median {}, 99 % {}, 99.9 % {}, max {}", time_of(histogram.quantile(0.5)), time_of(histogram.quantile(0.99)),
                       time_of(histogram.quantile(0.999)), time_of(histogram.max()));
}

/// True if live frames arrived one batch at a time at the pace of a clock. If they arrived in bulk, as from a file, jitter and input rate
/// are meaningless.
bool is_paced(const StreamReportInput& parts) {
    const auto& stats = parts.loop.stats();
    if (!parts.frames.is_live() || stats.rate() == 0) return false;
    const bool in_bulk = stats.received > 2 * static_cast<std::int64_t>(parts.skin.batch_frames()) * stats.reads;
    return !in_bulk || stats.rate() < 2 * parts.skin.clock().rate();
}

/// One line for each kind of problem that occurred.
std::string problems(const StreamReportInput& parts) {
    const auto counts = parts.frames.counts();
    const auto& order = counts.sequence;
    const auto& stats = parts.loop.stats();
    const std::pair<std::int64_t, std::string> all[] = {
        {order.gaps, fmt::format("{}: {} filled by the last force, {} by zero force", count_of(order.gaps, "gap"),
                                 count_of(order.held, "frame"), order.released)},
        {order.duplicates, count_of(order.duplicates, "duplicate frame") + " ignored"},
        {order.late, count_of(order.late, "late frame") + " ignored"},
        {order.restarts,
         fmt::format("the sender's frame numbers restarted {}", order.restarts == 1 ? "once" : count_of(order.restarts, "time"))},
        {counts.unreadable, count_of(counts.unreadable, "frame") + " unreadable: replaced by the last force"},
        {counts.invalid_values,
         count_of(counts.invalid_values, "reading") + " invalid or beyond --max-force: replaced by the last force of the site"},
        {counts.partial_frames, count_of(counts.partial_frames, "incomplete frame") + " at a disconnect"},
        {counts.senders.idle, count_of(counts.senders.idle, "sender") + " disconnected: idle while another was waiting"},
        {counts.senders.ignored, count_of(counts.senders.ignored, "datagram") + " from other senders ignored"},
        {counts.senders.dropped, count_of(counts.senders.dropped, "datagram") + " lost: they arrived faster than they were processed"},
        {static_cast<std::int64_t>(stats.unread),
         count_of(static_cast<std::int64_t>(stats.unread), "byte") + " of input unread at the end"},
        {stats.dropped, count_of(stats.dropped, "spike") + " dropped: the receiver was too slow and the buffer full"},
        {parts.sink.dropped(), count_of(parts.sink.dropped(), "spike") + " lost: the receiver disconnected or stopped reading"},
        {parts.skin.stats().truncated_steps,
         fmt::format("{} truncated at the spike limit of one step", count_of(parts.skin.stats().truncated_steps, "step"))},
    };
    std::string text;
    for (const auto& [count, message] : all)
        if (count > 0) text += "  " + message + "\n";
    return text;
}

/// The quantiles of a histogram of times (ns), in s.
nlohmann::ordered_json in_seconds(const LatencyHistogram& histogram) {
    const auto s = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-9; };
    return {{"count", histogram.count()},
            {"p50", s(histogram.quantile(0.5))},
            {"p99", s(histogram.quantile(0.99))},
            {"p99.9", s(histogram.quantile(0.999))},
            {"max", s(histogram.max())}};
}

}  // namespace

std::string stream_summary(const StreamReportInput& parts) {
    const auto& stats = parts.loop.stats();
    const auto counts = parts.frames.counts();
    const double T = parts.skin.clock().T();
    auto text = fmt::format("{} ({} of force), {} from {}\n", count_of(counts.frames, "frame"),
                            format_quantity(static_cast<double>(counts.frames + stats.filled) * T, "s"), count_of(stats.spikes, "spike"),
                            count_of(static_cast<std::int64_t>(parts.skin.innervation().afferents.size()), "afferent"));
    if (counts.sender_count != 1) text += fmt::format("  {}\n", count_of(counts.sender_count, "client"));
    if (parts.sink.connections() != 1) text += fmt::format("  {}\n", count_of(parts.sink.connections(), "connection") + " to the receiver");
    if (stats.latency.count() > 0) text += fmt::format("  latency from a frame to its written spikes: {}\n", quantiles(stats.latency));
    if (is_paced(parts)) text += fmt::format("  input rate {}; jitter: {}\n", format_quantity(stats.rate(), "Hz"), quantiles(stats.jitter));
    if (parts.page) text += fmt::format("  {}\n", page_summary(parts.page->counts()));
    return text + problems(parts);
}

std::string stream_status(const StreamReportInput& parts) {
    const auto& stats = parts.loop.stats();
    return fmt::format("{} frames  {} spikes  {} dropped  latency {} (99.9 %: {})", parts.frames.counts().frames, stats.spikes,
                       stats.dropped + parts.sink.dropped(), time_of(stats.latency.quantile(0.5)), time_of(stats.latency.quantile(0.999)));
}

nlohmann::ordered_json stream_document(const StreamReportInput& parts) {
    const auto& stats = parts.loop.stats();
    const auto counts = parts.frames.counts();
    const auto& plan = parts.skin.innervation().plan;
    nlohmann::ordered_json doc = {{"population", plan.name},
                                  {"sites", parts.skin.sites()},
                                  {"afferents", parts.skin.innervation().afferents.size()},
                                  {"rate_Hz", parts.skin.clock().rate()},
                                  {"frames", counts.frames},
                                  {"frames_filled", stats.filled},
                                  {"steps", parts.skin.frames()},
                                  {"spikes", stats.spikes}};
    if (plan.is_by_channel) doc["channels"] = plan.sites.names;  // binary events refer to channels by index
    doc["sequence"] = {{"gaps", counts.sequence.gaps},         {"held", counts.sequence.held},
                       {"released", counts.sequence.released}, {"duplicates", counts.sequence.duplicates},
                       {"late", counts.sequence.late},         {"restarts", counts.sequence.restarts}};
    doc["input"] = {{"senders", counts.sender_count},
                    {"headers", counts.headers},
                    {"unreadable", counts.unreadable},
                    {"invalid_values", counts.invalid_values},
                    {"incomplete", counts.partial_frames},
                    {"idle_senders", counts.senders.idle},
                    {"datagrams_ignored", counts.senders.ignored},
                    {"datagrams_dropped", counts.senders.dropped},
                    {"bytes_unread", stats.unread}};
    doc["events"] = {{"format", parts.format.name()},
                     {"to", parts.sink.description()},
                     {"dropped", stats.dropped},
                     {"undelivered", parts.sink.dropped()},
                     {"connections", parts.sink.connections()}};
    if (parts.page) doc["pages"] = page_document(parts.page->counts());
    doc["work"] = {{"afferent_steps", parts.skin.stats().afferent_steps},
                   {"at_rest", parts.skin.stats().skipped_steps},
                   {"truncated_steps", parts.skin.stats().truncated_steps}};
    doc["latency_s"] = in_seconds(stats.latency);
    const bool paced = is_paced(parts);
    doc["jitter_s"] = paced ? in_seconds(stats.jitter) : nullptr;
    doc["input_rate_Hz"] = paced ? nlohmann::ordered_json(stats.rate()) : nullptr;
    return doc;
}

}  // namespace corpuscle
