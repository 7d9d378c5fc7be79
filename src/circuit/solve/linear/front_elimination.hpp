#pragma once
// Gaussian elimination of one sparsity pattern in dense fronts, for matrices whose list of operations (Elimination) would be too long. The
// operations and their order depend on the pattern only, except that a matrix that is equal to its transpose is eliminated in half the
// time.

#include <optional>

#include "circuit/lanes/front_kernels.hpp"
#include "circuit/solve/linear/elimination.hpp"
#include "circuit/solve/linear/fronts.hpp"
#include "circuit/solve/linear/pivot_order.hpp"

namespace corpuscle::circuit {

/// P R A Q = L U, with row order P, column order Q and row scales R chosen in advance; R = 1 if A is symmetric. The matrix is in blocks:
/// those below the diagonal blocks are zero, and those above are not eliminated.
class FrontElimination {
    struct FrontEntry {      // a matrix entry in a diagonal block
        int entry, row;      // index in the array of values; row of A
        int mirror;          // entry of the transposed place; -1: none
        std::size_t offset;  // in the front
    };
    struct CouplingEntry {  // a matrix entry above the diagonal blocks
        int entry, row, column, row_of_A;
    };
    struct Node {
        std::size_t first_entry, first_upper, end_entry;  // in front_entries_: entries on and below the diagonal, then those above
        std::size_t first_child, end_child;               // in children_
        std::size_t lower, upper;                         // where its columns of L and rows of U begin
        std::size_t stride;
    };
    const lanes::FrontKernels* kernels_;
    FrontTree tree_;
    std::vector<Node> nodes_;
    std::vector<int> children_;         // the nodes below each node
    std::vector<int> place_in_parent_;  // by index in tree_.rows: row in the front of the parent
    std::vector<FrontEntry> front_entries_;
    std::vector<CouplingEntry> couplings_;  // block by block
    std::vector<int> zeros_;                // entries below the diagonal blocks, which must be 0
    struct Block {
        std::size_t end_node, end_coupling;  // of the block and those before
        int end_pivot;
    };
    std::vector<Block> blocks_;
    std::vector<int> rows_, columns_;  // P, Q: row and column of A, by pivot
    std::vector<double> scale_;        // R: factor of each row of A
    bool can_be_symmetric_ = true, is_symmetric_ = false;
    struct alignas(64) CacheLine {
        double values[8];
    };
    std::vector<CacheLine> buffers_;  // of a front and of the kernels
    std::size_t max_front_ = 0, max_size_ = 0, upper_size_ = 0;
    std::vector<double> lower_, upper_, inverse_pivot_, contributions_, coupling_values_;
    mutable std::vector<double> work_, rest_;  // buffers of solve()
    double growth_ = 0;

    FrontElimination() = default;
    void place_entries(const SparsityPattern&);
    void connect_nodes();
    void assemble(const Node&, std::span<const double> values, double* front) const;
    bool has_equal_halves(std::span<const double> values) const;
    lanes::FrontFactors factors_of(std::size_t node) const;

public:
    /// values: a matrix from which the row scales are computed. Nothing if there are no kernels for this machine.
    static std::optional<FrontElimination> make(const SparsityPattern&, const PivotOrder&, std::span<const double> values);

    /// Returns false if the pivot order is not stable for these values.
    bool factor(std::span<const double> values);
    void solve(std::span<double> b) const;     ///< A x = b, in place, after factor()
    double growth() const { return growth_; }  ///< largest magnitude in L of the last factorization
};

}  // namespace corpuscle::circuit
