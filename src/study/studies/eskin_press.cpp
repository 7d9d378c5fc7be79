// A press on an electronic skin of 21 optical sensors, with the spikes that its authors' network of 900 units and their haptic display
// made of it: the same press on a sheet of our afferents, time and place beside theirs.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "io/recording.hpp"
#include "io/spikes.hpp"
#include "study/sheet.hpp"
#include "study/studies.hpp"

namespace corpuscle::studies::eskin_press {

constexpr const char* folder = "fbg_eskin_press";
constexpr double rate = 100.04;                      // Hz, the mean; stamps are times of arrival, in bursts, up to 163 ms apart
constexpr double scale = 40;                         // N/nm; choice, for none is published: 8.9 N at most, as in doc/real-recordings.md
constexpr double sigma = 20e-3;                      // m, as far as sensors in a row stand apart; choice
constexpr double from = 17.3, to = 21.1, bin = 0.1;  // s: pressed, without the two edges
constexpr double late = 0.163;                       // s, the longest gap between two arrivals

/// Units that fired, and their spikes counted, by number.
using Counts = std::map<std::size_t, double>;

struct Published {
    std::vector<SheetSpike> network;  ///< units from 0
    std::map<std::string, std::vector<double>> motors;
};

Counts counts_of(const std::vector<SheetSpike>& spikes) {
    Counts out;
    for (const auto& s : spikes) out[s.unit] += 1;
    return out;
}

Result<SheetForce> read_force(const std::string& path, const std::string& layout) {
    auto source = open_recording(path, {.rate = rate, .scale = scale, .layout = layout});
    if (!source) return source.error();
    SheetForce out{(*source)->clock().T(), {}, {}};
    for (const auto& c : (*source)->channels()) out.at.push_back({c.position->x * 1e-3, c.position->y * 1e-3});  // mm
    out.force.resize(out.at.size());
    for (Frames block(out.at.size(), 1024);;) {
        if (auto ok = (*source)->read(block); !ok) return ok.error();
        if (block.count == 0) return out;
        for (std::size_t s = 0; s < out.at.size(); ++s)  // below 0 is no force
            for (std::size_t k = 0; k < block.count; ++k) out.force[s].push_back(std::max(0.0, block.force[s][k]));
    }
}

Result<Published> read_published(const std::string& from_folder) {
    Published out;
    const auto network = read_spikes(from_folder + "/snn_spikes_S6_T16.csv"),
               motors = read_spikes(from_folder + "/motor_spikes_S6_T16.csv");
    if (!network) return network.error();
    if (!motors) return motors.error();
    for (const auto& train : *network)
        for (const double t : train.times) out.network.push_back({t, std::stoul(train.afferent) - 1});
    std::sort(out.network.begin(), out.network.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    for (const auto& train : *motors) out.motors[train.afferent] = train.times;
    return out;
}

/// How far the units that fired lie from their middle if the sheet has so many columns: root of the mean square, in units.
double extent(const Counts& counts, std::size_t columns) {
    double n = 0, r = 0, c = 0, square = 0;
    const auto row = [&](std::size_t u) { return static_cast<double>(u / columns); };
    const auto column = [&](std::size_t u) { return static_cast<double>(u % columns); };
    for (const auto& [u, _] : counts) n += 1, r += row(u), c += column(u);
    for (const auto& [u, _] : counts) square += (row(u) - r / n) * (row(u) - r / n) + (column(u) - c / n) * (column(u) - c / n);
    return std::sqrt(square / n);
}

/// In how many columns they lie closest together.
std::size_t columns_of(const Counts& counts) {
    std::size_t best = 2;
    for (std::size_t c = 2; c <= 450; ++c)
        if (extent(counts, c) < extent(counts, best)) best = c;
    return best;
}

/// The unit that fired most.
std::size_t most_of(const Counts& counts) {
    return std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
}

/// How much two halves of the map differ that the row of its middle parts: as a share of all.
double lopsided(const Counts& counts, std::size_t columns, std::size_t middle) {
    double differ = 0, all = 0;
    for (const auto& [u, n] : counts) {
        const std::size_t row = u / columns, mirrored = (2 * middle - row) * columns + u % columns;
        const auto other = counts.find(mirrored);
        differ += std::abs(n - (other == counts.end() ? 0 : other->second)), all += n;
    }
    return differ / all / 2;
}

std::vector<double> times_of(const std::vector<SheetSpike>& spikes) {
    std::vector<double> out;
    for (const auto& s : spikes) out.push_back(s.time);
    return out;
}

std::vector<double> dense(const Counts& counts, const Sheet& sheet) {
    std::vector<double> out(sheet.rows * sheet.columns);
    for (const auto& [u, n] : counts)
        if (u < out.size()) out[u] = n;
    return out;
}

/// When the sensor that is pressed most is above a twentieth of its most.
std::pair<double, double> pressed(const SheetForce& force) {
    std::size_t most = 0;
    const auto top = [&](std::size_t s) { return *std::max_element(force.force[s].begin(), force.force[s].end()); };
    for (std::size_t s = 0; s < force.at.size(); ++s)
        if (top(s) > top(most)) most = s;
    const auto& f = force.force[most];
    const auto above = [&](double x) { return x > 0.05 * top(most); };
    const auto first = std::find_if(f.begin(), f.end(), above) - f.begin();
    const auto last = f.rend() - std::find_if(f.rbegin(), f.rend(), above) - 1;
    return {force.time(static_cast<std::size_t>(first)), force.time(static_cast<std::size_t>(last))};
}

/// The longest time between two spikes, s.
double longest_gap(const std::vector<double>& t) {
    double most = 0;
    for (std::size_t k = 1; k < t.size(); ++k) most = std::max(most, t[k] - t[k - 1]);
    return most;
}

struct All {
    Sheet sheet;
    SheetForce force;
    Published theirs;
    std::vector<SheetSpike> sa1, fa1;
};

/// What can be known of the network's numbers.
void tell_numbers(Outcome& out, const All& a) {
    const auto counts = counts_of(a.theirs.network);
    const std::size_t columns = columns_of(counts), top = most_of(counts);
    out.claim("network: units that fired", static_cast<double>(counts.size()), "units").printed_as(123, "the recording's README");
    out.claim("network: spikes", static_cast<double>(a.theirs.network.size()), "spikes").printed_as(42156, "the recording's README");
    out.claim("width of the sheet in which they lie closest together", static_cast<double>(columns), "units")
        .held_to(30, "900 units are 30 x 30, if the sheet is square; said nowhere");
    out.claim("their extent in it", extent(counts, columns), "units");
    out.claim("the same two units narrower", extent(counts, columns - 2), "units")
        .at_least(1.5 * extent(counts, columns), "as a check: no other width gives a disc");
    out.claim("the unit that fired most: row, from 0", static_cast<double>(top / columns));
    out.claim("the unit that fired most: column, from 0", static_cast<double>(top % columns));
    out.claim("halves on either side of its row differ by", lopsided(counts, columns, top / columns))
        .at_most(0.05, "as a check: the press is in the middle of the skin's width");
}

void tell_time(Outcome& out, const All& a) {
    const auto [on, off] = pressed(a.force);
    const auto both = [&](const char* who, const std::vector<double>& t) {
        if (t.empty()) return;
        out.claim(fmt::format("{}: first spike after the sensor's 5 %", who), t.front() - on, "s")
            .between(-late, late, "the recording's stamps: gaps of up to 163 ms");
        out.claim(fmt::format("{}: last spike after the sensor's 5 %", who), t.back() - off, "s")
            .between(-late, late, "the recording's stamps: gaps of up to 163 ms");
    };
    out.claim("sensor 11: above a twentieth of its most from", on, "s");
    out.claim("sensor 11: until", off, "s");
    both("network", times_of(a.theirs.network));
    std::vector<double> motors;
    for (const auto& [name, t] : a.theirs.motors) motors.insert(motors.end(), t.begin(), t.end());
    std::sort(motors.begin(), motors.end());
    both("display", motors);
    both("our SA-I", times_of(a.sa1));
    both("our FA-I", times_of(a.fa1));
    const auto share = [&](const std::vector<SheetSpike>& s) {
        double n = 0;
        for (const auto& x : s) n += x.time > on + 0.5 && x.time < off - 0.5;
        return n / static_cast<double>(s.size());
    };
    out.claim("network: its longest silence while the skin is pressed", longest_gap(times_of(a.theirs.network)), "s");
    out.claim("our SA-I: the same", longest_gap(times_of(a.sa1)), "s");
    out.claim("network: share of its spikes half a second and more from both edges", share(a.theirs.network));
    out.claim("our SA-I: the same share", share(a.sa1)).held_to(share(a.theirs.network), "the network's");
    out.claim("our FA-I: the same share", share(a.fa1)).at_most(0.5 * share(a.theirs.network), "a fast afferent tells the edges");
}

/// The display's spikes of each stretch.
std::vector<double> display_rate(const Published& theirs) {
    std::vector<SheetSpike> all;
    for (const auto& [name, t] : theirs.motors)
        for (const double x : t) all.push_back({x, 0});
    return track_of(Sheet{}, all, from, to, bin).weight;
}

void tell_place(Outcome& out, const All& a) {
    const auto sensors = track_of(a.force, from, to, bin), theirs = track_of(a.sheet, a.theirs.network, from, to, bin),
               ours = track_of(a.sheet, a.sa1, from, to, bin);
    const auto mean = [](const std::vector<double>& v) {
        double n = 0, sum = 0;
        for (const double x : v)
            if (std::isfinite(x)) n += 1, sum += x;
        return sum / n;
    };
    for (const auto& [who, track] : {std::pair{"sensors", &sensors}, {"our SA-I", &ours}, {"network, its numbers on our sheet", &theirs}}) {
        out.claim(fmt::format("{}: mean place across the skin", who), mean(track->x), "m");
        out.claim(fmt::format("{}: mean place along the skin", who), mean(track->y), "m");
    }
    const auto r = [&](const char* what, const std::vector<double>& v, const std::vector<double>& w, double least) -> Claim& {
        return out.claim(what, correlation(v, w)).at_least(least, "as a check: rates follow the place");
    };
    r("our SA-I follow the sensors across the skin: r", ours.x, sensors.x, 0.8);
    r("our SA-I follow the sensors along the skin: r", ours.y, sensors.y, 0.8)
        .if_off("sensors far from the press read 0.1 to 0.2 N, less than SA-I answer, but count in the sensors' mean place");
    r("the network's row follows the sensors across the skin: r", theirs.x, sensors.x, 0.5);
    r("the network's column follows the sensors along the skin: r", theirs.y, sensors.y, 0.5);
    r("the network's row and our SA-I across the skin: r", theirs.x, ours.x, 0.5);
    out.claim("rates of the network and of our SA-I over time: r", correlation(theirs.weight, ours.weight));
    out.claim("rates of the network and of the display over time: r", correlation(theirs.weight, display_rate(a.theirs)));
    const auto map = dense(counts_of(a.theirs.network), a.sheet), mine = dense(counts_of(a.sa1), a.sheet);
    r("spikes of 900 units, the network's and our SA-I, number by number: r", map, mine, 0.8);
    Plot across{"Where the press is, across the skin", "time (s)", "x (mm)", {}},
        along{"Where the press is, along the skin", "time (s)", "y (mm)", {}},
        rates{"Spikes, and the sensors' sum, in 100 ms", "time (s)", "of the largest", {}};
    for (const auto& [who, track] : {std::pair{"sensors", &sensors}, {"our SA-I", &ours}, {"network", &theirs}}) {
        const double most = *std::max_element(track->weight.begin(), track->weight.end());
        const auto line = [&](const std::vector<double>& v, double times) {
            Line scaled{track->t, v};
            for (double& y : scaled.y) y *= times;
            return scaled;
        };
        across.add(who, line(track->x, 1e3)), along.add(who, line(track->y, 1e3)), rates.add(who, line(track->weight, 1 / most));
    }
    for (auto* plot : {&across, &along, &rates}) out.plots.push_back(std::move(*plot));
}

Result<Outcome> work(const StudyOptions& options) {
    const std::string in = options.recordings + "/" + folder;
    if (!std::filesystem::is_directory(in))
        return bad_input(fmt::format("no recording is in '{}'; CORPUSCLE_DATA says in which folder '{}' lies", in, folder));
    All a;
    auto force = read_force(in + "/fbg_press_S6_T16.csv", in + "/sensor_positions.csv");
    if (!force) return force.error();
    a.force = std::move(*force);
    auto theirs = read_published(in);
    if (!theirs) return theirs.error();
    a.theirs = std::move(*theirs);
    a.sheet.corner = {-0.5 * static_cast<double>(a.sheet.rows) * a.sheet.pitch, 0};
    for (const auto& [name, spikes] : {std::pair{"sa1", &a.sa1}, {"fa1", &a.fa1}}) {
        auto answer = sheet_answer(a.sheet, name, a.force, sigma);
        if (!answer) return answer.error();
        *spikes = std::move(*answer);
        if (auto ok = options.at(name[0] == 's' ? 0.4 : 0.8); !ok) return ok.error();
    }
    Outcome out;
    tell_numbers(out, a);
    tell_time(out, a);
    tell_place(out, a);
    out.notes = {
        "Of the network's numbers this can be known from one press: in rows of 30 the units that fired are one round patch, cut by the "
        "sheet's edge at column 0; they drift in its rows as the pressed sensors do across the skin, and in its columns as they do along "
        "it, both rising. It cannot be known how many millimetres a number is, nor where the sheet begins: one place was pressed.",
        "Our sheet is 30 x 30, too, 4.5 mm apart (choice), in the middle of the skin's width and from its origin on: laid so, the "
        "network's "
        "patch is where the press is, by choice of those two numbers. What it proves is the drift, not the place.",
        "Times: sensors are taken at even 100.04 Hz, for their stamps are times of arrival, in bursts; the published spikes have the "
        "stamps' "
        "clock. At the onset the stamps are 17 ms behind the even clock, elsewhere up to 163 ms, and nothing nearer can be said of onset "
        "and release.",
        "Around 18.15 s the published network says nothing for a while, though the skin is pressed and its frames arrive: it is this that "
        "its "
        "rate and that of our SA-I mostly differ by. The display stops with it.",
        "The network is one of slowly adapting units; FA-I fire at the edges alone.",
        "Force: 40 N a nanometre, a choice; a unit feels the sum of all sensors, each times exp(-d^2 / 2 sigma^2), sigma of 20 mm, as far "
        "as "
        "sensors in a row stand apart."};
    return out;
}

const Study study{"eskin-press", "A press on an electronic skin, and its authors' network",
                  "Do rates of a sheet of our afferents follow the pressed place, and when do they begin and end beside the published "
                  "network's? Neuromorphic-Touch-Sensing-Haptic-Display, data of figure 2",
                  work, folder};

}  // namespace corpuscle::studies::eskin_press
