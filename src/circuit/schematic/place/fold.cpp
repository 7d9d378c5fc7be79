#include "circuit/schematic/place/fold.hpp"

#include <cmath>

namespace corpuscle::circuit::schematic {
namespace {

constexpr int longest_side = 2000;          // of a picture that is not broken
constexpr int most_elongated = 4;           // ratio of its sides
constexpr double wanted_ratio = 2;          // of width and height
constexpr int band_distance = 80;           // between two rows or columns, for the wires between them
constexpr double reach_of_cut = 1.0 / 3.0;  // of a band, to both sides of its wanted end

class Folder {
    Drawing& drawing_;
    std::vector<std::size_t> order_;  // the parts along the long side
    Box all_;
    bool is_row_ = true;  // false: a column

    struct Interval {
        int begin, end;
    };
    Box extent_of(std::size_t p) const { return drawing_.parts[p].shape.extent.shifted(drawing_.parts[p].at); }
    Interval along(const Box& box) const { return is_row_ ? Interval{box.left, box.right} : Interval{box.top, box.bottom}; }
    int length() const { return is_row_ ? all_.right - all_.left : all_.bottom - all_.top; }
    int breadth() const { return is_row_ ? all_.bottom - all_.top : all_.right - all_.left; }

    void set_extent() {
        all_ = {};
        for (const auto p : order_) all_.include(extent_of(p));
    }
    int count_of_bands() const {
        const double sides = length() / static_cast<double>(breadth() + band_distance);
        return static_cast<int>(std::lround(std::sqrt(is_row_ ? sides / wanted_ratio : sides * wanted_ratio)));
    }

    /// A place between two parts, through which no part extends.
    struct Cut {
        std::size_t after;  // the number of parts before it
        int at;
        int crossing;  // nets that a wire would have to carry across
    };
    std::vector<Cut> find_cuts() const {
        std::vector<std::size_t> pins_left(drawing_.level.nets.size());  // of nets, beyond the current part
        std::vector<bool> is_crossing(drawing_.level.nets.size());
        const auto each_net = [&](std::size_t p, const auto& use) {
            for (const auto& pin : drawing_.parts[p].shape.pins)
                if (pin.connection == Connection::wire) use(static_cast<std::size_t>(pin.net));
        };
        for (const auto p : order_) each_net(p, [&](std::size_t net) { ++pins_left[net]; });
        std::vector<Cut> cuts;
        int end = along(extent_of(order_.front())).end, crossing = 0;
        for (std::size_t k = 0; k < order_.size(); ++k) {
            const auto interval = along(extent_of(order_[k]));
            if (k > 0 && interval.begin >= end) cuts.push_back({k, interval.begin, crossing});
            end = std::max(end, interval.end);
            each_net(order_[k], [&](std::size_t net) {
                const bool crosses = --pins_left[net] > 0;
                if (crosses != is_crossing[net]) crossing += crosses ? 1 : -1;
                is_crossing[net] = crosses;
            });
        }
        return cuts;
    }

    /// The first parts of the bands after the first one.
    std::vector<Cut> choose_cuts(int bands) const {
        const auto cuts = find_cuts();
        std::vector<Cut> chosen;
        const double band = length() / static_cast<double>(bands);
        for (int k = 1; k < bands; ++k) {
            const double wanted = along(all_).begin + k * band;
            const Cut* best = nullptr;
            const auto is_better = [&](const Cut& a, const Cut& b) {
                return a.crossing != b.crossing ? a.crossing < b.crossing : std::abs(a.at - wanted) < std::abs(b.at - wanted);
            };
            for (const auto& cut : cuts)
                if (std::abs(cut.at - wanted) <= band * reach_of_cut && (best == nullptr || is_better(cut, *best))) best = &cut;
            if (best != nullptr) chosen.push_back(*best);
        }
        return chosen;
    }

    void move_bands(const std::vector<Cut>& cuts) {
        const int pitch = grid_ceil(breadth() + band_distance);
        std::size_t band = 0;
        for (std::size_t k = 0; k < order_.size(); ++k) {
            while (band < cuts.size() && cuts[band].after <= k) ++band;
            if (band == 0) continue;
            const int back = grid_floor(cuts[band - 1].at - along(all_).begin), across = static_cast<int>(band) * pitch;
            auto& at = drawing_.parts[order_[k]].at;
            at = at + (is_row_ ? Point{-back, across} : Point{across, -back});
        }
    }

public:
    Folder(Drawing& drawing, const std::vector<std::size_t>& parts) : drawing_(drawing), order_(parts) {}

    Box run() {
        set_extent();
        if (order_.empty()) return all_;
        is_row_ = all_.right - all_.left >= all_.bottom - all_.top;
        if (length() <= longest_side || length() <= most_elongated * breadth()) return all_;
        std::ranges::sort(order_, {}, [&](std::size_t part) { return std::pair(along(extent_of(part)).begin, part); });
        move_bands(choose_cuts(std::max(count_of_bands(), 2)));
        set_extent();
        return all_;
    }
};

}  // namespace

Box fold(Drawing& drawing, const std::vector<std::size_t>& parts) { return Folder(drawing, parts).run(); }

}  // namespace corpuscle::circuit::schematic
