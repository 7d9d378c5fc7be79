#pragma once
// The page server of `corpuscle stream --serve`: beside a stream, whose frames its pages show, or alone, with a session of the engine for
// each page (--in page).

#include "cli/stream/stream.hpp"
#include "live/serve/page_server.hpp"

namespace corpuscle {

/// Returns an error if options contradict --serve and --in page.
Result<void> check_page_options(const StreamArguments&, const CommonArguments&);

/// The server beside a stream.
class StreamPage {
    std::string page_;
    std::unique_ptr<FrameRing> ring_;
    std::unique_ptr<PageServer> server_;

public:
    /// Starts the server of --serve, and prints the addresses of its page.
    static Result<std::unique_ptr<StreamPage>> start(const StreamArguments&, const SkinStream&);
    FrameObserver* observer() { return ring_.get(); }
    /// Waits until a page is connected, or until Ctrl-C.
    void wait_for_viewer(bool quiet) const;
    void finish(std::int64_t frames, std::int64_t spikes);
    PageServerCounts counts() const { return server_->counts(); }
};

/// One line for the summary: "2 pages connected, at most 1 at once; 3 messages lost by slow pages".
std::string page_summary(const PageServerCounts&);
nlohmann::ordered_json page_document(const PageServerCounts&);

/// Runs the server of --serve with --in page until Ctrl-C. The summary has then been printed.
Result<void> run_page_sessions(const StreamArguments&, const CommonArguments&);

}  // namespace corpuscle
