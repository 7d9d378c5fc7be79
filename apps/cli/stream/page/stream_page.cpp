#include "cli/stream/page/stream_page.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/output/terminal.hpp"
#include "cli/stream/page/live_page.hpp"
#include "cli/stream/page/stream_messages.hpp"
#include "page/page_engine.hpp"

namespace corpuscle {
namespace {

constexpr std::uint32_t default_viewers = 256, default_sessions = 8;
constexpr std::size_t max_session_request = std::size_t{16} << 20;  // bytes: a recording that a page sends
constexpr double max_session_request_rate = 500;                    // Hz: a page asks once for each picture
constexpr auto patience = std::chrono::milliseconds(1000);          // at the end, for pages that are slow
constexpr auto check_interval = std::chrono::milliseconds(50);      // between calls of interrupted()

/// A session of the engine of the page.
class EngineSession final : public PageSession {
    page::PageEngine engine_;

public:
    Result<std::vector<std::byte>> request(std::span<const std::byte> message) override {
        try {
            return engine_.request(message);
        } catch (const std::bad_alloc&) {
            return bad_input("the request needs more memory than there is");
        } catch (const std::exception& error) {  // a defect; it must not end the sessions of others
            return bad_input(fmt::format("the engine failed: {}", error.what()));
        }
    }
    void stop() override { engine_.stop(); }
};

/// Starts a server, and prints the addresses of its page. These lines are printed with --quiet, too: they alone have the token, and the
/// port of --serve 0.
Result<std::unique_ptr<PageServer>> start_server(const StreamArguments& args, PageServerOptions options) {
    options.address = args.bind, options.port = static_cast<int>(*args.serve);
    options.encode_notice = encode_notice;
    auto server = TRY(PageServer::start(std::move(options)));
    for (const auto& url : server->urls()) print_message("open " + url);
    return server;
}

std::string count_text(std::int64_t n, std::string_view noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

}  // namespace

Result<void> check_page_options(const StreamArguments& args, const CommonArguments& common) {
    if (!args.serve) {
        if (args.in == "page") return bad_usage("--in page needs a server for the page; add --serve 8080");
        if (!args.bind.empty()) return bad_usage("--bind is the address of the page server; add --serve 8080");
        if (args.max_viewers) return bad_usage("--max-viewers is for the page server; add --serve 8080");
        return {};
    }
    if (args.in != "page") return {};
    for (const auto& option : common.typed) {
        static constexpr std::string_view allowed[] = {"--in", "--serve", "--bind", "--max-viewers", "--json", "--quiet"};
        if (std::find(std::begin(allowed), std::end(allowed), option.name) == std::end(allowed))
            return bad_usage(fmt::format("{} cannot be used with --in page, because the page chooses what is simulated", option.name));
    }
    return {};
}

Result<std::unique_ptr<StreamPage>> StreamPage::start(const StreamArguments& args, const SkinStream& skin) {
    auto out = std::make_unique<StreamPage>();
    PageServerOptions options;
    out->page_ = TRY(load_live_page("corpuscle-stream", options.max_request));
    out->ring_ = std::make_unique<FrameRing>(skin.sites(), skin.clock().rate());
    options.page = out->page_, options.frames = out->ring_.get();
    options.max_viewers = args.max_viewers.value_or(default_viewers);
    options.greeting = encode_stream_greeting(skin, out->ring_->force_interval());
    options.encode_frames = [clock = skin.clock()](const FrameBatch& batch) { return encode_frames(batch, clock); };
    out->server_ = TRY(start_server(args, std::move(options)));
    return out;
}

void StreamPage::wait_for_viewer(bool quiet) const {
    if (!quiet) print_message("the recording begins when a page is open");
    while (!interrupted() && server_->counts().viewers == 0) std::this_thread::sleep_for(check_interval);
}

void StreamPage::finish(std::int64_t frames, std::int64_t spikes) { server_->finish(encode_stream_end(frames, spikes), patience); }

std::string page_summary(const PageServerCounts& counts) {
    auto text = fmt::format("{} connected, at most {} at once", count_text(counts.connections, "page"), counts.max_viewers);
    const std::pair<std::int64_t, std::string> more[] = {
        {counts.lost_messages, count_text(counts.lost_messages, "message") + " not sent to slow pages"},
        {counts.lost_frames, count_text(counts.lost_frames, "frame") + " not shown: the server was slow"},
        {counts.lost_spikes, count_text(counts.lost_spikes, "spike") + " not shown: the server was slow"},
        {counts.turned_away, count_text(counts.turned_away, "page") + " more than --max-viewers"},
        {counts.disconnected, count_text(counts.disconnected, "page") + " disconnected: silent, stuck, or with invalid messages"},
        {counts.refused, count_text(counts.refused, "request") + " refused"},
    };
    for (const auto& [count, message] : more)
        if (count > 0) text += "; " + message;
    return text;
}

nlohmann::ordered_json page_document(const PageServerCounts& counts) {
    return {{"connections", counts.connections},     {"max_at_once", counts.max_viewers},   {"messages", counts.messages},
            {"lost_messages", counts.lost_messages}, {"lost_frames", counts.lost_frames},   {"lost_spikes", counts.lost_spikes},
            {"turned_away", counts.turned_away},     {"disconnected", counts.disconnected}, {"requests", counts.requests},
            {"requests_refused", counts.refused}};
}

Result<void> run_page_sessions(const StreamArguments& args, const CommonArguments& common) {
    const auto text = TRY(load_live_page("corpuscle-engine", max_session_request));
    PageServerOptions options;
    options.page = text;
    options.max_viewers = args.max_viewers.value_or(default_sessions);
    options.make_session = [] { return std::make_unique<EngineSession>(); };
    options.session_threads = std::max(1U, std::thread::hardware_concurrency());
    options.max_request = max_session_request, options.max_request_rate = max_session_request_rate;
    const auto server = TRY(start_server(args, std::move(options)));
    if (!common.quiet) print_message("each page has a simulation of its own; Ctrl-C ends them");
    while (!interrupted()) std::this_thread::sleep_for(check_interval);
    server->finish({}, patience);
    const auto counts = server->counts();
    nlohmann::ordered_json doc;
    doc["pages"] = page_document(counts);
    if (common.json) fmt::print("{}\n", json_text(doc));
    if (!common.quiet && !common.json) print_message(page_summary(counts));
    return interrupted_error();
}

}  // namespace corpuscle
