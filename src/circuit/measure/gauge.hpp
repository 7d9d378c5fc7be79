#pragma once
// What takes one number from a curve as its points come, in memory that does not grow.

#include <limits>
#include <optional>

#include "circuit/curves.hpp"
#include "circuit/measure/piece.hpp"

namespace corpuscle::circuit {

inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
inline constexpr double endless = std::numeric_limits<double>::infinity();

class Gauge {
public:
    virtual ~Gauge() = default;
    virtual void point(double x, const PlotRow&) = 0;
    /// Once all points have come; NaN: nothing was found.
    virtual double value() const = 0;
};

struct Stretch {
    double from = -endless, to = endless;
    bool holds(double x) const { return from <= x && x <= to; }
};

/// A curve less another one or a level, from point to point.
class Traced {
    CurveView curve_;
    std::optional<CurveView> other_;
    double level_ = 0;
    std::optional<Piece> piece_;  // the newest; of the first point a piece without length

public:
    explicit Traced(CurveView curve) : curve_(curve) {}
    Traced(CurveView curve, double level) : curve_(curve), level_(level) {}
    Traced(CurveView curve, CurveView other) : curve_(curve), other_(other) {}

    const std::optional<Piece>& piece() const { return piece_; }
    /// False: this was the first point, and there is no piece yet.
    bool point(double x, const PlotRow& row) {
        const double y = curve_.measured(row) - (other_ ? other_->measured(row) : level_);
        const bool first = !piece_;
        piece_ = first ? Piece{x, y, x, y} : Piece{piece_->x1, piece_->y1, x, y};
        return !first;
    }
};

/// Which of a curve's zeros are meant.
struct Edges {
    enum class Kind { rise, fall, cross } kind = Kind::cross;
    double which = 1;  ///< the first is 1; 0: the last
    Stretch within;    ///< only those in here count
};

/// Zeros of a curve, counted. With `which` the one that is meant is kept.
class Crossings {
    Traced traced_;
    Edges edges_;
    double count_ = 0, found_ = nothing;

public:
    Crossings(Traced traced, Edges edges) : traced_(std::move(traced)), edges_(edges) {}
    /// True: the one that is meant, or might be if none follows it, has come with this point.
    bool point(double x, const PlotRow&);
    double count() const { return count_; }
    double found() const { return found_; }  ///< NaN: it has not come
};

/// at=X, or where a crossing is.
struct Spot {
    double at = nothing;
    std::optional<Crossings> crossing;  ///< set: this is meant

    bool point(double x, const PlotRow& row) { return crossing && crossing->point(x, row); }
    double found() const { return crossing ? crossing->found() : at; }
};

/// when ...: where it is.
class Where final : public Gauge {
    Spot spot_;

public:
    explicit Where(Spot spot) : spot_(std::move(spot)) {}
    void point(double x, const PlotRow& row) override { spot_.point(x, row); }
    double value() const override { return spot_.found(); }
};

/// trig ... targ ...: how far the second is behind the first.
class Between final : public Gauge {
    Spot trigger_, target_;

public:
    Between(Spot trigger, Spot target) : trigger_(std::move(trigger)), target_(std::move(target)) {}
    void point(double x, const PlotRow& row) override { trigger_.point(x, row), target_.point(x, row); }
    double value() const override { return target_.found() - trigger_.found(); }
};

/// count ...: how many there are.
class Count final : public Gauge {
    Crossings crossings_;

public:
    explicit Count(Crossings crossings) : crossings_(std::move(crossings)) {}
    void point(double x, const PlotRow& row) override { crossings_.point(x, row); }
    double value() const override { return crossings_.count(); }
};

/// find and deriv: a curve's value, or its slope, at a spot.
class Found final : public Gauge {
    Traced curve_;
    bool slope_;
    Spot spot_;
    std::optional<Piece> first_;
    double value_ = nothing;

    double of(const Piece& piece, double x) const { return slope_ ? piece.slope() : piece.at(x); }

public:
    Found(Traced curve, bool slope, Spot spot) : curve_(std::move(curve)), slope_(slope), spot_(std::move(spot)) {}
    void point(double x, const PlotRow&) override;
    double value() const override;
};

/// min max pp avg rms integ min_at max_at, between two places.
class Summary final : public Gauge {
public:
    enum class Of { min, max, pp, min_at, max_at, avg, rms, integ };

private:
    Of of_;
    Traced curve_;
    Stretch stretch_;
    bool any_ = false;
    double low_ = 0, high_ = 0, low_at_ = 0, high_at_ = 0;
    double length_ = 0, area_ = 0, integral_ = 0, squares_ = 0, only_ = 0;

    void see(double x, double y);

public:
    Summary(Of of, Traced curve, Stretch stretch) : of_(of), curve_(std::move(curve)), stretch_(stretch) {}
    void point(double x, const PlotRow&) override;
    double value() const override;
};

/// Of an operating point, which is not swept: a curve's one value.
class AtRest final : public Gauge {
    CurveView curve_;
    double value_ = nothing;

public:
    explicit AtRest(CurveView curve) : curve_(curve) {}
    void point(double, const PlotRow& row) override { value_ = curve_.in(row).real(); }
    double value() const override { return value_; }
};

}  // namespace corpuscle::circuit
