// The engine as functions of C, which the worker of the live page calls.

#include <emscripten.h>

#include "page/page_engine.hpp"

namespace {

struct Engine {
    corpuscle::page::PageEngine engine;
    std::vector<std::byte> answer;
};

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE Engine* corpuscle_page_create() { return new Engine; }

/// Answers the request of `length` bytes (doc/page-protocol.md). The answer is valid until the next request.
EMSCRIPTEN_KEEPALIVE const std::byte* corpuscle_page_request(Engine* engine, const std::byte* request, std::size_t length) {
    engine->answer = engine->engine.request(std::span(request, length));
    return engine->answer.data();
}
EMSCRIPTEN_KEEPALIVE std::size_t corpuscle_page_answer_length(const Engine* engine) { return engine->answer.size(); }

}  // extern "C"
