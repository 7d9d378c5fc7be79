// Refuses --serve in a program that was built without Boost.

#include "live/serve/page_server.hpp"

namespace corpuscle {

Result<std::unique_ptr<PageServer>> PageServer::start(PageServerOptions) {
    return bad_usage(
        "--serve: this program was built without its page server; install the package libboost-dev, and build it again (make build)");
}

}  // namespace corpuscle
