#include "circuit/refusals.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {

void Refusals::add(Error error, Kind kind) {
    if (is_full() || !texts_.insert(error.text()).second) return;
    refusals_.push_back({kind, std::move(error), "", {}, 0});
}

void Refusals::add_device(Error error, const std::string& subject, std::string name) {
    const auto same = std::ranges::find(refusals_, subject, &Refusal::subject);
    if (same == refusals_.end()) {
        add(std::move(error), Kind::device);
        if (!refusals_.empty() && refusals_.back().subject.empty()) refusals_.back().subject = subject;
        return;
    }
    ++same->other_count;
    if (same->others.size() < max_names) same->others.push_back(std::move(name));
}

void Refusals::add_elements_of(const Refusals& other) {
    const auto may_be_defined = [](const Error& error) {
        return std::ranges::any_of(
            std::initializer_list<std::string_view>{"unknown name", "unknown model", "unknown subcircuit", "unknown function"},
            [&](std::string_view text) { return error.message.find(text) != std::string::npos; });
    };
    for (const auto& refusal : other.refusals_)
        if (refusal.kind == Kind::device)
            refusals_.push_back(refusal);
        else if (!may_be_defined(refusal.error))
            add(refusal.error, refusal.kind);
}

void Refusals::add_all_of(const Refusals& other) {
    for (const auto& refusal : other.refusals_)
        if (!is_full() && texts_.insert(refusal.error.text()).second) refusals_.push_back(refusal);
}

std::string Refusals::message_of(const Refusal& refusal) {
    if (refusal.others.empty()) return refusal.error.message;
    const auto more = refusal.other_count - refusal.others.size();
    return fmt::format("{}; also {}{}", refusal.error.message, joined(refusal.others), more == 0 ? "" : fmt::format(" and {} more", more));
}

Error Refusals::combined() const {
    std::vector<Error> errors;
    for (const auto kind : {Kind::device, Kind::directive, Kind::other})
        for (const auto& refusal : refusals_) {
            if (refusal.kind != kind) continue;
            errors.push_back(refusal.error);
            errors.back().message = message_of(refusal);
        }
    if (errors.size() > max_reported) {
        const auto more = errors.size() - max_reported;
        errors.resize(max_reported);
        errors.push_back(bad_input(fmt::format("{} further errors", more)));
    }
    Error out = std::move(errors.front());
    errors.erase(errors.begin());
    if (!errors.empty()) out.further = std::make_shared<const std::vector<Error>>(std::move(errors));
    return out;
}

}  // namespace corpuscle::circuit
