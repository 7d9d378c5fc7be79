#include "skin/contact/contact.hpp"

#include <fmt/format.h>

#include "core/stimulus/touch.hpp"
#include "core/text/quantity.hpp"
#include "skin/contact/contact_shear.hpp"
#include "skin/contact/skin_cells.hpp"
#include "skin/contact/sliding_texture.hpp"

namespace corpuscle {
namespace {

/// A site, and the fraction of the force on the indenter that it receives.
struct SiteFraction {
    std::uint32_t site;
    double fraction;
};

/// How a force is distributed over the sites by a contact at a position, of a size, and with a shift of the pattern under it. The fractions
/// are computed again only if one of the others changes.
struct Distribution {
    Position at;
    double size = -1, shift = 0;  // m; size -1: none yet
    std::vector<SiteFraction> fractions = {};
    double on_skin = 0;  // sum of the fractions: the fraction of the force that is on the skin
};

std::string in_mm(double x, double y) { return fmt::format("({:.4g}, {:.4g}) mm", x * 1e3, y * 1e3); }

/// The duration of the movement to x1, y1, s.
double move_duration(const ContactParams& p) {
    const double dx = p.x1 - p.x, dy = p.y1 - p.y;
    return is_moving(p) && p.speed > 0 ? num::sqrt(dx * dx + dy * dy) / p.speed : p.t_move;
}

/// The movement of the indenter's surface over the skin. A surface that passes under a resting contact moves along its ridges' normal or,
/// without ridges, along x.
SlidingTexture::Motion surface_motion(const Indenter& indenter, const ContactParams& p) {
    const Position origin{p.x, p.y, 0};
    if (const double duration = move_duration(p); is_moving(p) && duration > 0)
        return {{(p.x1 - p.x) / duration, (p.y1 - p.y) / duration, 0}, origin, p.t_start, p.t_start + duration};
    const double turns = indenter.name == "grating" ? p.angle / 360 : 0;
    const Position velocity{p.speed * num::cos_turns(turns), p.speed * num::sin_turns(turns), 0};
    return {velocity, origin, p.t_start, std::numeric_limits<double>::infinity()};
}

class IndenterContact final : public Contact {
    const Indenter& indenter_;
    ContactParams p_;
    Clock clock_;
    const Sites& sites_;
    SkinCells cells_;
    double move_duration_;  // s
    std::unique_ptr<PressureDistribution> pressure_;
    SlidingTexture texture_;
    std::optional<SlidingTexture> free_texture_;  // instead of texture_, once a block has positions
    Position passing_;                            // m/s, velocity of a surface that passes under the contact
    std::uint64_t seed_;

    ContactShear shear_;
    bool has_shear_ = false;    // true: of shear_, or with the force of the block
    bool is_touching_ = false;  // at the last sample

    Distribution pressed_by_, stuck_by_;  // of the force at the last sample, and of the part of the contact that sticks
    std::vector<double> column_;          // scratch array of distribute()

    // The result of press() for the current block: members of SiteForce.
    std::size_t stride_ = 0;
    std::vector<double> force_, shear_x_force_, shear_y_force_;
    std::vector<std::uint32_t> touched_;
    std::vector<char> in_block_;  // for each site: 1 if it is in touched_

    // Data for the notes, of all samples so far.
    double pressed_ = 0, off_skin_ = 0;  // force on the indenter, and the part of it off the skin; N, summed over samples
    double max_size_ = 0;                // largest size of the contact, m
    std::int64_t negative_samples_ = 0;

    /// The position of the contact's centre (m) at time t (s, on the clock of the force).
    Position position_at(double t) const {
        // Fraction of the way from the start to the end.
        const double fraction = move_duration_ > 0 ? ramp_fraction(t, p_.t_start, move_duration_) : 0;
        return {p_.x + (p_.x1 - p_.x) * fraction, p_.y + (p_.y1 - p_.y) * fraction, 0};
    }

    /// The distance (m) that a pattern, such as a grating's, has passed under a resting contact at time t.
    double pattern_shift(double t) const { return !is_moving(p_) && t > p_.t_start ? p_.speed * (t - p_.t_start) : 0; }

    /// Computes the fraction of the force on each site, for the position and size of the contact and the shift of a pattern under it (m).
    void distribute(const Position& at, double size, double shift, Distribution& out) {
        if (size == out.size && shift == out.shift && at.x == out.at.x && at.y == out.at.y) return;
        out.at = at, out.size = size, out.shift = shift;
        out.fractions.clear();
        double all = 0, on = 0;
        const auto half = pressure_->box(size);
        cells_.for_each_column(at.x, at.y, half.width, half.height,
                               [&](double x0, std::span<const double> edges, std::span<const std::uint32_t> sites) {
                                   if (column_.size() < edges.size() * 2) column_.resize(edges.size() * 2);
                                   double* y = column_.data() + edges.size();
                                   for (std::size_t k = 0; k < edges.size(); ++k) y[k] = edges[k] - at.y;
                                   pressure_->column(size, shift, x0 - at.x, cells_.side(), {y, edges.size()}, column_.data());
                                   for (std::size_t k = 0; k < sites.size(); ++k) {
                                       all += column_[k];
                                       if (!(column_[k] > 0) || sites[k] == SkinCells::no_site) continue;
                                       on += column_[k], out.fractions.push_back({sites[k], column_[k]});
                                   }
                               });
        out.on_skin = all > 0 ? on / all : 0;
        for (auto& s : out.fractions) s.fraction /= all;
    }

    /// Adds the traction q for a normal force (N) at a site to its shear in sample k of the block.
    void add_shear(const ShearTraction& q, std::uint32_t site, double force, std::size_t k) {
        shear_x_force_[site * stride_ + k] += q.x * (q.ratio * force), shear_y_force_[site * stride_ + k] += q.y * (q.ratio * force);
    }

    /// Spreads a tangential force (N) like the normal force of sample k of the block.
    void spread_shear(double x, double y, std::size_t k) {
        for (const auto& s : pressed_by_.fractions)
            shear_x_force_[s.site * stride_ + k] = x * s.fraction, shear_y_force_[s.site * stride_ + k] = y * s.fraction;
    }

    /// Sets the shear of sample k of the block, at time t, under this normal force.
    void shear_once(double t, double force, std::size_t k) {
        const auto q = shear_.at(t, force, *pressure_);
        if (q.ratio == 0) return;
        for (const auto& s : pressed_by_.fractions) add_shear(q, s.site, force_[s.site * stride_ + k], k);
        if (!(q.stuck_force > 0)) return;
        distribute(pressed_by_.at, pressure_->size(q.stuck_force), pressed_by_.shift, stuck_by_);
        for (const auto& s : stuck_by_.fractions) add_shear(q, s.site, -q.stuck_force * s.fraction, k);
    }

    /// Adds a site to those touched in the block, which has `steps` steps, with zero force.
    void touch(std::uint32_t site, std::size_t steps) {
        if (in_block_[site]) return;
        in_block_[site] = 1;
        touched_.push_back(site);
        for (auto* f : {&force_, &shear_x_force_, &shear_y_force_})
            if (!f->empty()) std::fill_n(f->begin() + static_cast<std::ptrdiff_t>(site * stride_), steps, 0.0);
    }

    /// Refuses a contact that is too large for the cells of the skin.
    Result<void> check(double size, double force) const {
        constexpr double max_cells = 1e6;
        const auto half = pressure_->box(size);
        if (half.width * half.height * 4 <= max_cells * cells_.side() * cells_.side()) return {};
        return bad_input(fmt::format("contact: with {} it is {} by {} wide, which is more than a million cells of {} of this skin",
                                     format_quantity(force, "N"), format_quantity(2 * half.width, "m"),
                                     format_quantity(2 * half.height, "m"), format_quantity(cells_.side(), "m")));
    }

    /// Distributes the force of sample k of the block.
    Result<void> press_once(const ContactForce& block, std::size_t k) {
        const double force = block.force[k];
        is_touching_ = force > 0;
        if (!is_touching_) {
            negative_samples_ += force < 0;
            shear_.release();
            if (free_texture_) free_texture_->lift();
            return {};
        }
        const double t = clock_.time(block.first + static_cast<std::int64_t>(k)), size = pressure_->size(force);
        TRY(check(size, force));
        distribute(block.x.empty() ? position_at(t) : Position{block.x[k], block.y[k], 0}, size, pattern_shift(t), pressed_by_);
        auto& texture = block.x.empty() ? texture_ : *free_texture_;
        if (block.x.empty())
            texture.move_to(t);
        else
            texture.move_to({pressed_by_.at.x + passing_.x * t, pressed_by_.at.y + passing_.y * t, 0}, clock_.T());
        pressed_ += force, off_skin_ += force * (1 - pressed_by_.on_skin), max_size_ = std::max(max_size_, size);
        for (const auto& s : pressed_by_.fractions) {
            touch(s.site, block.force.size());
            force_[s.site * stride_ + k] = force * s.fraction * std::max(0.0, 1 + texture.at(s.site));
        }
        if (shear_.any()) shear_once(t, force, k);
        return {};
    }

public:
    IndenterContact(const Indenter& indenter, const ContactParams& p, const Sites& sites, const Clock& clock, std::uint64_t seed)
        : indenter_(indenter), p_(p), clock_(clock), sites_(sites), cells_(sites), move_duration_(move_duration(p)),
          pressure_(make_pressure_distribution(indenter, p, cells_.side())),
          texture_(indenter, p, sites, surface_motion(indenter, p), clock.rate(), seed),
          passing_(is_moving(p) ? Position{} : surface_motion(indenter, p).velocity), seed_(seed), shear_(p, surface_motion(indenter, p)),
          in_block_(sites.size(), 0) {}

    std::string description() const override {
        const auto length = [](double m) { return format_quantity(m, "m"); };
        std::string text = indenter_.name == "sphere" ? fmt::format("a sphere of {}", length(p_.radius))
                           : indenter_.name == "flat" ? fmt::format("a flat punch of {}", length(p_.radius))
                           : indenter_.name == "edge" ? fmt::format("an edge {} long", length(p_.length))
                                                      : fmt::format("a grating with a ridge every {}", length(p_.period));
        if (indenter_.name != "grating" && p_.roughness > 0) text += fmt::format(" with bumps every {}", length(p_.grain));
        if (!is_moving(p_) && p_.speed > 0) text += fmt::format(" moving past at {}", format_quantity(p_.speed, "m/s"));
        if (!is_moving(p_)) return text + fmt::format(", pressed at {}", in_mm(p_.x, p_.y));
        return text +
               fmt::format(", moved from {} to {} in {}", in_mm(p_.x, p_.y), in_mm(p_.x1, p_.y1), format_quantity(move_duration_, "s"));
    }

    std::vector<MetadataEntry> metadata() const override {
        std::vector<MetadataEntry> out;
        const auto& used = indenter_.parameters;
        for (const auto& f : contact_fields) {
            const bool is_end = f.name == "x1" || f.name == "y1", is_start = f.name == "x" || f.name == "y";
            const bool has_effect = is_end ? is_moving(p_) : is_start || p_.*f.member != 0;
            // A flat punch uses E_star only for friction.
            if (f.name == "E_star" && indenter_.name == "flat" && !(p_.friction > 0)) continue;
            if (std::find(used.begin(), used.end(), f.name) != used.end() || (is_path_parameter(f.name) && has_effect))
                out.push_back({fmt::format("contact.{}", f.name), p_.*f.member, std::string(f.unit)});
        }
        return out;
    }

    std::vector<std::string> notes() const override {
        std::vector<std::string> out = {fmt::format(
            "the contact model is a rigid indenter on flat, elastic{} and unbounded skin, without {}the curvature and edges of the finger; "
            "depth and adaptation belong to the afferents",
            has_shear_ ? "" : ", frictionless", has_shear_ ? "" : "shear, slip, or ")};
        if (shear_.any()) out.push_back(contact_shear_note(indenter_, p_));
        if (!cells_.is_lattice())
            out.push_back(fmt::format(
                "the sites are not on a lattice: each was treated as a square of {}, and together they receive all of the force",
                format_quantity(cells_.side(), "m")));
        if (pressed_ > 0 && off_skin_ > 1e-9 * pressed_)
            out.push_back(
                fmt::format("{:.3g} % of the force, over time, was off the skin and reached no afferent", 100 * off_skin_ / pressed_));
        if (texture_.left_out() > 0)
            out.push_back(
                fmt::format("the texture vibrates around {}; {:.2g} % of its mean square are at or above half the sampling rate of "
                            "{} and were left out; --rate gives stimuli a higher one",
                            format_quantity(texture_.frequency(), "Hz"), 100 * texture_.left_out(), format_quantity(clock_.rate(), "Hz")));
        if (indenter_.name == "sphere" && max_size_ > 0.5 * p_.radius)
            out.push_back(fmt::format(
                "the contact radius reached {}, more than half of the sphere's radius; Hertz's theory is only valid for small contacts",
                format_quantity(max_size_, "m")));
        if (negative_samples_ > 0) out.push_back(fmt::format("{} samples with negative force caused no contact", negative_samples_));
        return out;
    }

    ContactState state() const override { return is_touching_ ? ContactState{pressed_by_.size, pressed_by_.on_skin} : ContactState{}; }

    Result<SiteForce> press(const ContactForce& block) override {
        const auto& force = block.force;
        if (!block.shear_x.empty() && shear_.any())
            return bad_input("contact: the force has its own shear; remove contact.tilt and contact.friction");
        if (!block.x.empty() && !free_texture_) free_texture_.emplace(indenter_, p_, sites_, seed_);
        has_shear_ = has_shear_ || shear_.any() || !block.shear_x.empty();  // the last block of a force is empty
        for (const auto site : touched_) in_block_[site] = 0;
        touched_.clear();
        if (force.size() > stride_) {
            stride_ = force.size();
            force_.assign(sites_.size() * stride_, 0.0);
        }
        if (has_shear_ && shear_x_force_.size() < force_.size()) shear_x_force_ = shear_y_force_ = force_;
        for (std::size_t k = 0; k < force.size(); ++k) {
            if (!std::isfinite(force[k]))
                return bad_input(
                    fmt::format("the force of sample {} is {}, not a finite number", block.first + static_cast<std::int64_t>(k), force[k]));
            TRY(press_once(block, k));
            if (!block.shear_x.empty() && force[k] > 0) spread_shear(block.shear_x[k], block.shear_y[k], k);
        }
        std::sort(touched_.begin(), touched_.end());
        if (!has_shear_) return SiteForce{force_.data(), stride_, touched_, false};
        return SiteForce{force_.data(), stride_, touched_, false, shear_x_force_.data(), shear_y_force_.data()};
    }
};

}  // namespace

Result<Applied<std::unique_ptr<Contact>>> make_contact(std::string_view name, std::span<const ParameterOverride> overrides,
                                                       const Sites& sites, const Clock& clock, std::uint64_t seed) {
    const auto indenter = TRY(find_indenter(name));
    auto params = TRY(read_contact_params(*indenter, overrides, sites));
    return Applied<std::unique_ptr<Contact>>{std::make_unique<IndenterContact>(*indenter, params.result, sites, clock, seed),
                                             std::move(params.unused)};
}

std::span<const NamedTouch> named_touches() {
    static const std::vector<NamedTouch> all = {
        {"stroke",
         "ramp-hold",
         "sphere",
         "a fingertip pressed with 1 N and moved from the palm to the tip of the index finger of 'hand' in 10 s",
         {{"radius", 8e-3}, {"x", 29.6e-3}, {"y", 52.6e-3}, {"x1", 47.2e-3}, {"y1", 177.4e-3}, {"t_move", 10}},
         {{"F_max", 1}, {"t_rest", 0}, {"t_up", 0.1}, {"t_hold", 9.8}, {"t_down", 0.1}, {"t_post", 0}}},
        {"texture",
         "ramp-hold",
         "sphere",
         "as stroke, but with a rough surface (bumps every 0.5 mm) and at 80 mm/s: the skin vibrates around 160 Hz",
         {{"radius", 8e-3},
          {"roughness", 0.03},
          {"grain", 0.5e-3},
          {"x", 29.6e-3},
          {"y", 52.6e-3},
          {"x1", 47.2e-3},
          {"y1", 177.4e-3},
          {"t_start", 0.2},
          {"speed", 80e-3}},
         {{"F_max", 1}, {"t_rest", 0}, {"t_up", 0.1}, {"t_hold", 1.8}, {"t_down", 0.1}, {"t_post", 0}}},
        {"scan",
         "ramp-hold",
         "grating",
         "a grating with a ridge every 4 mm, pressed with 2 N and moved over a patch of skin ('fingertip') at 80 mm/s for 2 s",
         {{"radius", 5.6e-3}, {"period", 4e-3}, {"ridge", 2e-3}, {"speed", 80e-3}},
         {{"F_max", 2}, {"t_rest", 0.1}, {"t_up", 0.1}, {"t_hold", 2}, {"t_down", 0.1}, {"t_post", 0.2}}},
    };
    return all;
}

}  // namespace corpuscle
