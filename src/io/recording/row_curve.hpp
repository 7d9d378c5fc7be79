#pragma once
// The curve through the rows of a recording, for samples between them.
//
// Linear: a straight line from row to row. Its corners have all frequencies, so afferents that adapt fast answer each of them.
// Smooth: a cubic B-spline with the rows as control points. For rows a, b, c, d, and s from 0 at b to 1 at c:
//     ((1-s)^3 a + (3s^3 - 6s^2 + 4) b + (-3s^3 + 3s^2 + 3s + 1) c + s^3 d) / 6
// Its slope and curvature are continuous. The weights are positive and add up to 1, so it never leaves the range of these four rows, and
// four equal rows are a constant. It does not pass through the rows: a frequency f is multiplied by about 1 - (pi f / rate)^2 2/3.
// Before the first row and after the last, these are repeated.

#include <vector>

#include "io/recording/recording.hpp"

namespace corpuscle {

class RowCurve {
public:
    struct Row {
        std::vector<double> force;  ///< of each channel, N
        double t = 0;               ///< s
    };

    explicit RowCurve(Interpolation kind) : is_smooth_(kind == Interpolation::smooth) {}

    /// Moves to the next row. `read_row` is a function that overwrites a Row with the next one, and returns false after the last. Returns
    /// false if there is no next row; the curve then stays.
    template <class F>
    Result<bool> advance(F&& read_row) {
        if (is_smooth_) return advance_smooth(read_row);
        const bool has_row = TRY(read_row(next_));
        if (!has_row) return false;
        std::swap(before_, at_), std::swap(at_, next_), ++rows_;
        return true;
    }

    bool has_begun() const { return rows_ > 0; }
    double time() const { return at_.t; }  ///< of the row to which the curve has moved, s

    /// The force of channel c at time t (s), at or before time() and not before that of the row before it.
    double force(std::size_t c, double t) const {
        const double s = rows_ == 1 ? 1 : std::clamp((t - before_.t) / (at_.t - before_.t), 0.0, 1.0);
        if (!is_smooth_) return rows_ == 1 ? at_.force[c] : before_.force[c] + (at_.force[c] - before_.force[c]) * s;
        // As differences from b, so that four equal rows are a constant without rounding.
        const double r = 1 - s, s2 = s * s, s3 = s2 * s, b = before_.force[c];
        return b +
               (r * r * r * (earlier_.force[c] - b) + (3 * s2 - 3 * s3 + 3 * s + 1) * (at_.force[c] - b) + s3 * (next_.force[c] - b)) / 6;
    }

private:
    bool is_smooth_, has_next_ = false;
    std::int64_t rows_ = 0;             // to which the curve has moved so far
    Row earlier_, before_, at_, next_;  // four rows in order; next_ is used by the smooth curve only

    template <class F>
    Result<bool> advance_smooth(F& read_row) {
        if (rows_ == 0) {
            const bool has_row = TRY(read_row(at_));
            if (!has_row) return false;
            earlier_ = before_ = at_;
        } else {
            if (!has_next_) return false;
            std::swap(earlier_, before_), std::swap(before_, at_), std::swap(at_, next_);
        }
        has_next_ = TRY(read_row(next_));
        if (!has_next_) next_ = at_;
        return ++rows_, true;
    }
};

}  // namespace corpuscle
