// The engine as functions of C, for JavaScript. engine_interface.js wraps them.

#include <emscripten.h>

#include "page/page_engine.hpp"

namespace {

struct Engine {
    corpuscle::page::PageEngine engine;
    std::vector<std::byte> answer;
};

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE Engine* corpuscle_create() { return new Engine; }
EMSCRIPTEN_KEEPALIVE void corpuscle_free(Engine* engine) { delete engine; }

/// Answers the request of `size` bytes. The answer is valid until the next request.
EMSCRIPTEN_KEEPALIVE const std::byte* corpuscle_request(Engine* engine, const std::byte* request, std::size_t size) {
    engine->answer = engine->engine.request(std::span(request, size));
    return engine->answer.data();
}
EMSCRIPTEN_KEEPALIVE std::size_t corpuscle_answer_size(const Engine* engine) { return engine->answer.size(); }

}  // extern "C"
