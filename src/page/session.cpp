#include "page/session.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "io/sandbox/helper_process.hpp"
#include "page/documents.hpp"
#include "page/save/saved_spikes.hpp"
#include "run/channels/channel_warnings.hpp"

namespace corpuscle::page {
namespace {

constexpr std::size_t max_block = 100'000;    // samples of one `advance`
constexpr std::size_t max_kept = 10'000'000;  // spikes
constexpr std::uint64_t max_seed = 1ULL << 53;

Json row_answer(const Row& row, const RowBlock& block, const SimulationOptions& options) {
    Json out = {{"spikes", block.spikes.size()}};
    if (!block.probes.empty()) out["first"] = static_cast<double>(block.first_value) * options.dt, out["values"] = block.probes[0].size();
    if (block.steps > 0) out["steps"] = block.steps, out["rejected"] = block.rejected, out["iterations"] = block.iterations;
    if (block.energy.seconds > 0)
        out["power"] = block.energy.supplies / block.energy.seconds, out["sensor_power"] = block.energy.sensor / block.energy.seconds;
    for (const auto& violation : block.range_violations) out["outside"].push_back(violation.samples);
    if (!row.error().empty()) out["error"] = row.error();
    return out;
}

Json operating_document(const OperatingState& state, double origin) {
    Json out = {{"time", origin + state.time}, {"supply", state.supply}, {"power", state.power}, {"sensor_power", state.sensor}};
    out["sources"] = out["blocks"] = Json::array();
    for (const auto& s : state.sources) out["sources"].push_back({{"name", s.name}, {"power", s.power}, {"current", s.current}});
    for (const auto& b : state.blocks) {
        Json block = {{"name", b.name}, {"power", b.power}, {"nodes", Json::array()}, {"devices", Json::array()}};
        for (const auto& n : b.nodes) block["nodes"].push_back({{"name", n.name}, {"voltage", n.voltage}});
        for (const auto& d : b.devices) block["devices"].push_back({{"name", d.name}, {"current", d.current}});
        out["blocks"].push_back(std::move(block));
    }
    return out;
}

}  // namespace

Result<Clock> read_clock(ObjectReader& request) { return make_clock(TRY(request.number("rate", 10, 1e6))); }

Result<Session> Session::start(ObjectReader& request, MessageWriter& answer) {
    Session out;
    out.clock_ = TRY(read_clock(request));
    out.options_.dt = out.clock_.T();
    out.options_.seed = TRY(request.integer("seed", 0, max_seed, 0));
    const auto rows = TRY(read_row_requests(request));
    const auto* skin = TRY(request.object("skin"));
    TRY(request.check_all_read());
    for (const auto& row : rows) out.rows_.push_back(TRY(Row::make(row, out.options_, 0)));
    answer.head["rate"] = out.clock_.rate(), answer.head["seed"] = out.options_.seed;
    answer.head["rows"] = Json::array();
    for (const auto& row : out.rows_) answer.head["rows"].push_back(row.document(out.options_.dt));
    auto units = out.rows_.size();
    answer.head["warnings"] = Json::array();
    if (skin) {
        ObjectReader object(*skin, "skin");
        out.skin_ = TRY(PressedSkin::make(TRY(read_skin_request(object)), out.options_, out.clock_));
        out.skin_->describe(answer, units);
        out.at_ = out.skin_->middle();
        units += out.skin_->afferents();
        for (const auto& warning : out.skin_->warnings()) answer.head["warnings"].push_back(warning);
    }
    for (const auto& row : out.rows_)
        if (auto text = rate_warning(row.plan(), row.plan().name, out.clock_.rate()); !text.empty())
            answer.head["warnings"].push_back(std::move(text));
    answer.head["units"] = units;
    answer.head["formats"] = {"csv"};
    if (find_helper_program("corpuscle-hdf5")) answer.head["formats"].push_back("nwb");
    return out;
}

std::vector<RowRequest> Session::row_requests() const {
    std::vector<RowRequest> out;
    for (const auto& row : rows_) out.push_back(row.request());
    return out;
}

void Session::keep(std::span<const Spike> spikes) {
    spikes_.insert(spikes_.end(), spikes.begin(), spikes.end());
    if (spikes_.size() <= max_kept) return;
    const auto surplus = spikes_.size() - max_kept / 2;
    spikes_.erase(spikes_.begin(), spikes_.begin() + static_cast<std::ptrdiff_t>(surplus));
    dropped_ += surplus;
}

/// The force, position and shear of a request. `arrays` stores them.
Result<ContactForce> Session::contact_force(ObjectReader& request, std::size_t samples, std::vector<std::vector<double>>& arrays) const {
    const auto has = [&](const char* name) { return request.has(name) || request.array(name) != nullptr; };
    for (const auto& [first, second] : {std::pair("x", "y"), {"shear_x", "shear_y"}})
        if (has(first) != has(second)) return bad_input(fmt::format("{}: give both {} and {}, or neither", request.name(), first, second));
    arrays.push_back(TRY(signal(request, "force", samples, 0)));
    ContactForce out{arrays[0], samples_};
    for (const auto& [name, values, standard] :
         {std::tuple("x", &out.x, at_.x), {"y", &out.y, at_.y}, {"shear_x", &out.shear_x, 0.0}, {"shear_y", &out.shear_y, 0.0}}) {
        arrays.push_back(TRY(signal(request, name, samples, standard)));
        if (values == &out.x || values == &out.y || has(name)) *values = arrays.back();
    }
    return out;
}

/// Presses the skin; the answer's parts for its classes and its contact.
Result<Json> Session::advance_skin(const ContactForce& force, const std::atomic<bool>& is_stopped, std::vector<Spike>& spikes) {
    const auto first_unit = static_cast<std::uint32_t>(rows_.size());
    const auto first_spike = spikes.size();
    if (const auto done = skin_->press(force, is_stopped, first_unit, spikes); !done) {
        if (skin_->samples() != samples_) failure_ = done.error().text();
        return done.error();
    }
    const auto& skin = skin_->innervation();
    std::vector<std::size_t> counts(skin.plan.classes.size());
    for (auto k = first_spike; k < spikes.size(); ++k) ++counts[skin.afferents[spikes[k].afferent_index - first_unit].class_index];
    Json out = {{"classes", Json::array()}};
    for (std::size_t c = 0; c < counts.size(); ++c) out["classes"].push_back({{"name", skin.plan.classes[c].name}, {"spikes", counts[c]}});
    const auto contact = skin_->contact().state();
    out["contact"] = {{"radius", contact.size}, {"on_skin", contact.on_skin}};
    return out;
}

Result<void> Session::advance(ObjectReader& request, const std::atomic<bool>& is_stopped, MessageWriter& answer) {
    const auto samples = static_cast<std::size_t>(TRY(request.integer("samples", 1, max_block)));
    const auto every = static_cast<std::size_t>(TRY(request.integer("every", 0, max_block, 0)));
    if (!failure_.empty()) return bad_input(fmt::format("advance: after this error the simulation must be started again: {}", failure_));
    std::vector<std::vector<double>> arrays;
    arrays.reserve(5);
    const auto force = TRY(contact_force(request, samples, arrays));
    TRY(request.check_all_read());
    std::vector<Spike> spikes;
    if (skin_) answer.head.update(TRY(advance_skin(force, is_stopped, spikes)));
    answer.head["from"] = samples_, answer.head["to"] = samples_ + static_cast<std::int64_t>(samples);
    answer.head["rows"] = Json::array();
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const auto block = rows_[r].simulate(force.force, static_cast<std::uint32_t>(r), every, options_.dt, is_stopped);
        if (is_stopped) return stopped_error();
        spikes.insert(spikes.end(), block.spikes.begin(), block.spikes.end());
        answer.head["rows"].push_back(row_answer(rows_[r], block, options_));
        for (std::size_t p = 0; p < block.probes.size(); ++p) answer.add(fmt::format("probe.{}.{}", r, p), std::span(block.probes[p]));
    }
    samples_ += static_cast<std::int64_t>(samples);
    at_ = {force.x.back(), force.y.back(), 0};
    std::sort(spikes.begin(), spikes.end());
    add_spikes(answer, spikes, clock_);
    keep(spikes);
    return {};
}

Result<void> Session::change_contact(ObjectReader& request, MessageWriter& answer) {
    const auto indenter = TRY(request.text("indenter"));
    const auto set = TRY(request.texts("set"));
    TRY(request.check_all_read());
    if (!skin_) return bad_input("contact: the session has no skin; start one with the key \"skin\"");
    TRY(skin_->change_contact(indenter, set, clock_));
    answer.head["contact"] = skin_->contact().description(), answer.head["contact_parameters"] = skin_->contact_parameters();
    return {};
}

Result<void> Session::change_row(ObjectReader& request, MessageWriter& answer) {
    const auto index = TRY(request.integer("row", 0, max_seed));
    auto set = TRY(request.texts("set"));
    TRY(request.check_all_read());
    if (index >= rows_.size()) return bad_input(fmt::format("set: there is no row {}; the session has {}", index, rows_.size()));
    const bool is_carried = TRY(rows_[index].change(std::move(set), options_, samples_));
    answer.head["state"] = is_carried ? "carried" : "restarted";
    answer.head["row"] = rows_[index].document(options_.dt);
    return {};
}

Result<void> Session::operating(ObjectReader& request, MessageWriter& answer) const {
    const auto index = TRY(request.integer("row", 0, max_seed));
    TRY(request.check_all_read());
    if (index >= rows_.size()) return bad_input(fmt::format("operating: there is no row {}; the session has {}", index, rows_.size()));
    const auto state = TRY(rows_[index].operating_state());
    answer.head.update(operating_document(state, rows_[index].origin(options_.dt)));
    return {};
}

/// The force that `save` has as an array.
Result<SavedForce> Session::force_to_save(ObjectReader& request) const {
    SavedForce out{static_cast<std::int64_t>(TRY(request.integer("force_from", 0, max_seed, 0))), {}};
    const auto* array = request.array("force");
    if (array) out.values = TRY(numbers_of(*array));
    if (out.first + static_cast<std::int64_t>(out.values.size()) > samples_)
        return bad_input(fmt::format("save: the force ends after sample {}, the last one that was simulated", samples_));
    return out;
}

Result<void> Session::save(ObjectReader& request, MessageWriter& answer) const {
    const auto format = TRY(request.text("format", "csv"));
    const auto force = TRY(force_to_save(request));
    TRY(request.check_all_read());
    auto spikes = spikes_;
    std::sort(spikes.begin(), spikes.end());  // those of circuits came later than others
    const SavedSpikes saved{rows_, skin_ ? &skin_->innervation() : nullptr, spikes, dropped_ == 0, clock_, samples_};
    if (format == "csv")
        answer.add("file", spikes_csv(saved));
    else if (format == "nwb")
        answer.add("file", TRY(spikes_nwb(saved, force)));
    else
        return bad_input(fmt::format("save: there is no format '{}' (there are csv and nwb)", format));
    answer.head["name"] = "spikes." + format, answer.head["dropped"] = dropped_;
    return {};
}

}  // namespace corpuscle::page
