#include "reproduction/readout/linear_readout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace corpuscle {
namespace {

using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;  // rows

double product(const Vector& a, const Vector& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

/// Replaces a symmetric positive definite matrix by its Cholesky factor L, in the lower triangle: A = L L'.
void factorize(Matrix& a) {
    for (std::size_t r = 0; r < a.size(); ++r)
        for (std::size_t c = 0; c <= r; ++c) {
            const auto end = a[c].begin() + static_cast<std::ptrdiff_t>(c);
            const double rest = a[r][c] - std::inner_product(a[c].begin(), end, a[r].begin(), 0.0);
            a[r][c] = r == c ? std::sqrt(rest) : rest / a[c][c];
        }
}

/// Solves L L' x = b.
Vector solve(const Matrix& l, Vector b) {
    for (std::size_t r = 0; r < b.size(); ++r) {
        for (std::size_t c = 0; c < r; ++c) b[r] -= l[r][c] * b[c];
        b[r] /= l[r][r];
    }
    for (std::size_t r = b.size(); r-- > 0;) {
        for (std::size_t c = r + 1; c < b.size(); ++c) b[r] -= l[c][r] * b[c];
        b[r] /= l[r][r];
    }
    return b;
}

/// Scales features to mean 0 and deviation 1 over some trials, divided by the root of their number: the square of a trial is then 1 on
/// average.
class Scaling {
    Vector mean_, factor_;  // factor 0: the feature is constant

public:
    explicit Scaling(const std::vector<const ReadoutTrial*>& trials) {
        const auto n = static_cast<double>(trials.size());
        double varying = 0;
        for (std::size_t k = 0; k < trials.front()->features.size(); ++k) {
            double sum = 0, squares = 0;
            for (const auto* t : trials) sum += t->features[k];
            for (const auto* t : trials) squares += std::pow(t->features[k] - sum / n, 2);
            mean_.push_back(sum / n), factor_.push_back(squares > 0 ? std::sqrt(n / squares) : 0), varying += squares > 0;
        }
        for (auto& f : factor_) f /= std::sqrt(std::max(varying, 1.0));
    }
    Vector operator()(const ReadoutTrial& trial) const {
        Vector out;
        for (std::size_t k = 0; k < mean_.size(); ++k) out.push_back((trial.features[k] - mean_[k]) * factor_[k]);
        return out;
    }
};

/// The ridge regression in its dual form: the weights of the features are a sum over the trials, x = sum of z a.
class LinearReadout {
    Scaling scaling_;
    Matrix learned_;   // the scaled features of each trial
    Matrix weights_;   // a, [class][trial]
    Vector fraction_;  // of the trials in each class

public:
    LinearReadout(const std::vector<const ReadoutTrial*>& trials, std::size_t classes, double ridge) : scaling_(trials) {
        for (const auto* t : trials) learned_.push_back(scaling_(*t));
        Matrix kernel;
        for (std::size_t r = 0; r < trials.size(); ++r) {
            kernel.emplace_back();
            for (std::size_t c = 0; c <= r; ++c) kernel[r].push_back(product(learned_[r], learned_[c]) + (r == c ? ridge : 0));
        }
        factorize(kernel);
        for (std::size_t label = 0; label < classes; ++label) {
            Vector target;
            for (const auto* t : trials) target.push_back(t->label == label);
            fraction_.push_back(std::accumulate(target.begin(), target.end(), 0.0) / static_cast<double>(trials.size()));
            for (auto& v : target) v -= fraction_.back();
            weights_.push_back(solve(kernel, std::move(target)));
        }
    }
    std::size_t read(const ReadoutTrial& trial) const {
        const auto features = scaling_(trial);
        Vector similarity, value = fraction_;
        for (const auto& z : learned_) similarity.push_back(product(features, z));
        for (std::size_t c = 0; c < value.size(); ++c) value[c] += product(similarity, weights_[c]);
        return static_cast<std::size_t>(std::max_element(value.begin(), value.end()) - value.begin());
    }
};

}  // namespace

std::vector<bool> read_correctly(const std::vector<const ReadoutTrial*>& learned, const std::vector<const ReadoutTrial*>& tested,
                                 double ridge) {
    std::size_t classes = 0;
    for (const auto* trials : {&learned, &tested})
        for (const auto* t : *trials) classes = std::max(classes, t->label + 1);
    const LinearReadout readout(learned, classes, ridge);
    std::vector<bool> out;
    for (const auto* t : tested) out.push_back(readout.read(*t) == t->label);
    return out;
}

double readout_accuracy(const std::vector<ReadoutTrial>& trials, std::size_t folds, std::size_t block, double ridge) {
    std::size_t correct = 0;
    for (std::size_t fold = 0; fold < folds; ++fold) {
        std::vector<const ReadoutTrial*> learned, left_out;
        for (std::size_t k = 0; k < trials.size(); ++k) (k / block % folds == fold ? left_out : learned).push_back(&trials[k]);
        for (const bool is_correct : read_correctly(learned, left_out, ridge)) correct += is_correct;
    }
    return static_cast<double>(correct) / static_cast<double>(trials.size());
}

}  // namespace corpuscle
