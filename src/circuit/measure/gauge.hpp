#pragma once
// Measurements for .meas: each takes one number from a curve point by point, in constant memory.

#include <limits>
#include <optional>

#include "circuit/curves.hpp"
#include "circuit/measure/piece.hpp"

namespace corpuscle::circuit {

inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
inline constexpr double endless = std::numeric_limits<double>::infinity();

/// A measurement of one number. Derived classes are below.
class Gauge {
public:
    virtual ~Gauge() = default;
    virtual void point(double x, const PlotRow&) = 0;
    /// The result after the last point; NaN if nothing was found.
    virtual double value() const = 0;
};

/// An interval of the swept quantity.
struct Stretch {
    double from = -endless, to = endless;
    bool holds(double x) const { return from <= x && x <= to; }
};

/// A curve minus another curve or a level, followed point by point.
class Traced {
    CurveView curve_;
    std::optional<CurveView> other_;
    double level_ = 0;
    std::optional<Piece> piece_;  // the newest segment; after the first point a segment of length 0

public:
    explicit Traced(CurveView curve) : curve_(curve) {}
    Traced(CurveView curve, double level) : curve_(curve), level_(level) {}
    Traced(CurveView curve, CurveView other) : curve_(curve), other_(other) {}

    const std::optional<Piece>& piece() const { return piece_; }
    /// Returns false at the first point, which does not complete a segment.
    bool point(double x, const PlotRow& row) {
        const double y = curve_.measured(row) - (other_ ? other_->measured(row) : level_);
        const bool first = !piece_;
        piece_ = first ? Piece{x, y, x, y} : Piece{piece_->x1, piece_->y1, x, y};
        return !first;
    }
};

/// Selects some zero crossings of a curve.
struct Edges {
    enum class Kind { rise, fall, cross } kind = Kind::cross;
    double which = 1;  ///< 1 is the first crossing; 0 is the last
    Stretch within;    ///< only crossings in this interval count
};

/// Counts the zero crossings of a curve and keeps the position of the selected one.
class Crossings {
    Traced traced_;
    Edges edges_;
    double count_ = 0, found_ = nothing;

public:
    Crossings(Traced traced, Edges edges) : traced_(std::move(traced)), edges_(edges) {}
    /// Returns true if the newest segment has the selected crossing. For the last crossing, true at every crossing so far.
    bool point(double x, const PlotRow&);
    double count() const { return count_; }
    double found() const { return found_; }  ///< NaN if it was not found yet
};

/// A position: at=X, or the position of a crossing.
struct Spot {
    double at = nothing;
    std::optional<Crossings> crossing;  ///< if set, replaces `at`

    bool point(double x, const PlotRow& row) { return crossing && crossing->point(x, row); }
    double found() const { return crossing ? crossing->found() : at; }
};

/// when ...: the position of a crossing.
class Where final : public Gauge {
    Spot spot_;

public:
    explicit Where(Spot spot) : spot_(std::move(spot)) {}
    void point(double x, const PlotRow& row) override { spot_.point(x, row); }
    double value() const override { return spot_.found(); }
};

/// trig ... targ ...: the distance from the first position to the second.
class Between final : public Gauge {
    Spot trigger_, target_;

public:
    Between(Spot trigger, Spot target) : trigger_(std::move(trigger)), target_(std::move(target)) {}
    void point(double x, const PlotRow& row) override { trigger_.point(x, row), target_.point(x, row); }
    double value() const override { return target_.found() - trigger_.found(); }
};

/// count ...: the number of crossings.
class Count final : public Gauge {
    Crossings crossings_;

public:
    explicit Count(Crossings crossings) : crossings_(std::move(crossings)) {}
    void point(double x, const PlotRow& row) override { crossings_.point(x, row); }
    double value() const override { return crossings_.count(); }
};

/// find and deriv: the value or the slope of a curve at a position.
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

/// min max pp avg rms integ min_at max_at over an interval.
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

    void update_extremes(double x, double y);

public:
    Summary(Of of, Traced curve, Stretch stretch) : of_(of), curve_(std::move(curve)), stretch_(stretch) {}
    void point(double x, const PlotRow&) override;
    double value() const override;
};

/// The value of a curve at an operating point, which has no sweep.
class AtRest final : public Gauge {
    CurveView curve_;
    double value_ = nothing;

public:
    explicit AtRest(CurveView curve) : curve_(curve) {}
    void point(double, const PlotRow& row) override { value_ = curve_.in(row).real(); }
    double value() const override { return value_; }
};

}  // namespace corpuscle::circuit
