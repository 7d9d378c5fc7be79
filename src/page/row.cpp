#include "page/row.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "io/table/foreign_format.hpp"
#include "page/documents.hpp"
#include "run/afferent_plan.hpp"

namespace corpuscle::page {
namespace {

constexpr std::size_t max_rows = 64;

/// The page must not read files of the machine on which the engine runs.
Result<void> refuse_path(const std::string& afferent) {
    if (afferent.find_first_of("./\\") == std::string::npos) return {};
    return bad_input(fmt::format("'{}' is the path of a file; {}", afferent, file_afferent_advice(afferent)));
}

/// True if an afferent can go on from a state of another. The codes of a converter of 12 bits, for example, do not fit into one of 8.
bool accepts(const Afferent& afferent, State state) {
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    return static_cast<bool>(afferent.respond({}, state, response));
}

}  // namespace

std::string file_afferent_advice(const std::string& file) {
    return fmt::format("the page has built-in circuits and equations only; type: corpuscle respond press --afferent {}",
                       quote_shell_word(file));
}

Result<RowRequest> read_row_request(ObjectReader& object) {
    RowRequest out;
    out.afferent = TRY(object.text("afferent"));
    out.set = TRY(object.texts("set"));
    out.probes = TRY(object.texts("probes"));
    return out;
}

Result<std::vector<RowRequest>> read_row_requests(ObjectReader& request) {
    std::vector<RowRequest> out;
    for (const auto* object : TRY(request.objects("rows"))) {
        if (out.size() == max_rows) return bad_input(fmt::format("there are more than {} rows", max_rows));
        ObjectReader row(*object, fmt::format("row {}", out.size()));
        out.push_back(TRY(read_row_request(row)));
        TRY(row.check_all_read());
    }
    return out;
}

Result<AfferentPlan> plan_row(const RowRequest& request) {
    TRY(refuse_path(request.afferent));
    std::vector<ParameterOverride> overrides;
    for (const auto& setting : request.set) {
        auto parsed = TRY(parse_override(request.afferent + "." + setting));
        parsed.typed = setting;
        overrides.push_back(std::move(parsed));
    }
    auto planned = TRY(plan_any_afferent(request.afferent, overrides, request.probes));
    const std::string_view targets[] = {request.afferent};
    TRY(check_all_used(planned.unused, targets));
    if (!request.probes.empty() && planned.probes.empty())
        return bad_input(fmt::format("{}: \"probes\" are for circuits; those of equations are always recorded", request.afferent));
    for (std::size_t k = 0; k < planned.probes.size(); ++k)
        if (!planned.probes[k].name)
            return bad_input(fmt::format("{} has no probe '{}'{}", request.afferent, request.probes[k], planned.probes[k].hint));
    return std::move(planned.result);
}

Result<Row> Row::make(RowRequest request, const SimulationOptions& options, std::int64_t now) {
    Row out;
    out.plan_ = TRY(plan_row(request));
    out.request_ = std::move(request);
    out.afferent_ = make_afferent(out.plan_, options);
    out.state_ = out.afferent_->start();
    out.origin_ = now;
    return out;
}

Json Row::document(double dt) const {
    auto out = document_of(plan_);
    out["probes"] = document_of(afferent_->probes());
    out["ranges"] = document_of(afferent_->ranges());
    out["delay"] = static_cast<double>(afferent_->delay()) * dt;
    out["parameters"] = parameters_document(plan_);
    return out;
}

Result<bool> Row::change(std::vector<std::string> set, const SimulationOptions& options, std::int64_t now) {
    auto changed = request_;
    changed.set = std::move(set);
    auto next = TRY(make(std::move(changed), options, now));
    const bool is_carried = error_.empty() && accepts(*next.afferent_, state_);
    if (is_carried) next.state_ = std::move(state_), next.origin_ = origin_;
    *this = std::move(next);
    return is_carried;
}

/// Simulates a block in parts of a tenth of a second, between which it can be stopped; a circuit can be stopped within a part, too.
/// `probes`: where their values in the block begin.
Result<void> Row::respond(std::span<const double> force, double dt, const std::atomic<bool>& is_stopped, std::vector<double*> probes,
                          ResponseBlock& response) {
    constexpr double part = 0.1;  // s
    const auto samples = static_cast<std::size_t>(std::max(1.0, part / dt));
    response.probes = probes;
    response.should_stop = [&is_stopped] { return is_stopped.load(); };
    for (std::size_t at = 0; at < force.size() && !is_stopped; at += samples) {
        TRY(afferent_->respond(force.subspan(at, std::min(samples, force.size() - at)), state_, response));
        for (auto& values : probes) values += samples;
    }
    response.probes = {}, response.should_stop = {};
    return {};
}

RowBlock Row::simulate(std::span<const double> force, std::uint32_t index, std::size_t every, double dt,
                       const std::atomic<bool>& is_stopped) {
    RowBlock out;
    const auto first = origin_ + state_.step - afferent_->delay();
    const bool records = every > 0 && error_.empty();
    std::vector<std::vector<double>> values(records ? afferent_->probes().size() : 0, std::vector<double>(force.size()));
    std::vector<double*> arrays;
    for (auto& v : values) arrays.push_back(v.data());
    out.probes.resize(values.size());
    out.range_violations.resize(afferent_->ranges().size());
    if (!error_.empty()) return out;
    ResponseBlock response{out.spikes, index, {}, out.range_violations};
    if (const auto done = respond(force, dt, is_stopped, std::move(arrays), response); !done) error_ = done.error().text();
    for (auto& spike : out.spikes) spike.step += origin_;
    out.steps = response.steps, out.rejected = response.rejected_steps, out.iterations = response.newton_iterations;
    out.energy = response.energy_use;
    if (!records) return out;
    // The first sample of the block that is not before the start and is a multiple of `every`.
    const auto stride = static_cast<std::int64_t>(every), from = std::max(first, origin_);
    out.first_value = (from + stride - 1) / stride * stride;
    for (std::size_t p = 0; p < values.size(); ++p)
        for (auto k = static_cast<std::size_t>(out.first_value - first); k < force.size(); k += every)
            out.probes[p].push_back(static_cast<float>(values[p][k]));
    return out;
}

}  // namespace corpuscle::page
