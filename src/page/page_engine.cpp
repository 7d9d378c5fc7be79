#include "page/page_engine.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <new>

#include "page/catalogue_answer.hpp"
#include "page/documents.hpp"
#include "page/recording_answer.hpp"
#include "page/response_job.hpp"
#include "page/session.hpp"

namespace corpuscle::page {

struct PageEngine::Impl {
    std::optional<Session> session;
    std::optional<ResponseJob> job;
    std::optional<KeptRecording> recording;  // of the last `read` that asked to keep it

    const KeptRecording* kept() const { return recording ? &*recording : nullptr; }
    std::atomic<bool> is_stopped = false;  // by another thread
};

namespace {

using Engine = PageEngine::Impl;

struct Request {
    ObjectReader& head;
    MessageWriter& answer;
};

Result<Session*> session_of(Engine& engine, const Request& request) {
    if (!engine.session) return bad_input(fmt::format("{}: there is no session; send the request \"start\" first", request.head.name()));
    return &*engine.session;
}

/// Runs the job of the engine, and removes it if it has ended.
Result<void> run_job(Engine& engine, const Request& request, double seconds) {
    TRY(engine.job->run(seconds, engine.is_stopped, request.answer));
    if (engine.job->is_done()) engine.job.reset();
    return {};
}

Result<void> answer_catalogue(Engine&, const Request& request) {
    TRY(request.head.check_all_read());
    describe_catalogue(request.answer);
    return {};
}

Result<void> answer_settable(Engine&, const Request& request) {
    const RowRequest row{TRY(request.head.text("afferent")), {}, {}};
    TRY(request.head.check_all_read());
    const auto plan = TRY(plan_row(row));
    request.answer.head["settable"] = document_of(TRY(plan.factory->settable_values()));
    return {};
}

Result<void> answer_schematic(Engine&, const Request& request) {
    const RowRequest row{TRY(request.head.text("afferent")), TRY(request.head.texts("set")), {}};
    const auto block = TRY(request.head.text("block", ""));
    TRY(request.head.check_all_read());
    const auto plan = TRY(plan_row(row));
    request.answer.add("svg", TRY(plan.factory->schematic(block)));
    return {};
}

Result<void> answer_start(Engine& engine, const Request& request) {
    engine.session = TRY(Session::start(request.head, request.answer));
    return {};
}

Result<void> answer_advance(Engine& engine, const Request& request) {
    return TRY(session_of(engine, request))->advance(request.head, engine.is_stopped, request.answer);
}

Result<void> answer_contact(Engine& engine, const Request& request) {
    return TRY(session_of(engine, request))->change_contact(request.head, request.answer);
}

Result<void> answer_set(Engine& engine, const Request& request) {
    return TRY(session_of(engine, request))->change_row(request.head, request.answer);
}

Result<void> answer_respond(Engine& engine, const Request& request) {
    const double slice = TRY(request.head.number("slice", 0, 10, 0));
    auto rows = engine.session ? engine.session->row_requests() : std::vector<RowRequest>();
    engine.job = TRY(ResponseJob::respond(request.head, std::move(rows), engine.kept()));
    return run_job(engine, request, slice);
}

Result<void> answer_monte_carlo(Engine& engine, const Request& request) {
    const double slice = TRY(request.head.number("slice", 0, 10, 0));
    engine.job = TRY(ResponseJob::monte_carlo(request.head, engine.kept()));
    return run_job(engine, request, slice);
}

Result<void> answer_continue(Engine& engine, const Request& request) {
    const double slice = TRY(request.head.number("slice", 0, 10, 0));
    TRY(request.head.check_all_read());
    if (!engine.job) return bad_input("continue: nothing is being computed; send respond or monte-carlo first");
    return run_job(engine, request, slice);
}

Result<void> answer_cancel(Engine& engine, const Request& request) {
    TRY(request.head.check_all_read());
    engine.job.reset();
    return {};
}

Result<void> answer_operating(Engine& engine, const Request& request) {
    return TRY(session_of(engine, request))->operating(request.head, request.answer);
}

Result<void> answer_read(Engine& engine, const Request& request) { return read_recording(request.head, engine.recording, request.answer); }

Result<void> answer_save(Engine& engine, const Request& request) {
    return TRY(session_of(engine, request))->save(request.head, request.answer);
}

struct Handler {
    std::string_view name;
    Result<void> (*answer)(Engine&, const Request&);
};
constexpr Handler handlers[] = {{"catalogue", answer_catalogue},
                                {"settable", answer_settable},
                                {"schematic", answer_schematic},
                                {"start", answer_start},
                                {"advance", answer_advance},
                                {"contact", answer_contact},
                                {"set", answer_set},
                                {"respond", answer_respond},
                                {"monte-carlo", answer_monte_carlo},
                                {"continue", answer_continue},
                                {"cancel", answer_cancel},
                                {"operating", answer_operating},
                                {"read", answer_read},
                                {"save", answer_save}};

Result<const Handler*> find_handler(const std::string& name) {
    std::vector<std::string_view> known;
    for (const auto& handler : handlers) {
        if (handler.name == name) return &handler;
        known.push_back(handler.name);
    }
    return bad_input(fmt::format("there is no request '{}'{} (there are {})", name, did_you_mean(name, known), fmt::join(known, ", ")));
}

/// Answers a request. `head` receives the keys that also an error has.
Result<void> handle(Engine& engine, std::span<const std::byte> bytes, MessageWriter& answer, Json& head) {
    const auto message = TRY(read_message(bytes));
    ObjectReader start(message.head, "request");
    const auto name = TRY(start.text("request"));
    head["answer"] = name;
    ObjectReader reader(message.head, name, message.arrays);
    TRY(reader.text("request"));
    if (reader.has("id")) {
        if (const auto& id = message.head["id"]; id.is_string() || id.is_number()) head["id"] = id;
    }
    const auto* handler = TRY(find_handler(name));
    answer.head = head;
    return handler->answer(engine, {reader, answer});
}

}  // namespace

PageEngine::PageEngine() : impl_(std::make_unique<Impl>()) {}
PageEngine::~PageEngine() = default;
PageEngine::PageEngine(PageEngine&&) noexcept = default;
void PageEngine::stop() { impl_->is_stopped = true; }

std::vector<std::byte> PageEngine::request(std::span<const std::byte> bytes) {
    MessageWriter answer;
    auto head = Json::object();
    if (const auto done = handle(*impl_, bytes, answer, head); !done) {
        MessageWriter failure;
        failure.head = std::move(head);
        failure.head["error"] = done.error().text();
        return failure.finish();
    }
    return answer.finish();
}

}  // namespace corpuscle::page
