#pragma once
// Connected nodes of a circuit.

#include <numeric>
#include <vector>

namespace corpuscle::circuit {

/// Sets of connected nodes (union-find).
class NodeSets {
    std::vector<int> parent_;

public:
    explicit NodeSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
    int root(int k) {
        auto& up = parent_[static_cast<std::size_t>(k)];
        while (up != parent_[static_cast<std::size_t>(up)]) up = parent_[static_cast<std::size_t>(up)];
        return up;
    }
    /// Unites the sets of a and b. Returns false if both were in one set already.
    bool join(int a, int b) {
        a = root(a), b = root(b);
        if (a == b) return false;
        parent_[static_cast<std::size_t>(a)] = b;
        return true;
    }
};

}  // namespace corpuscle::circuit
