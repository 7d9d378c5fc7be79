#pragma once
// The results of the variants of a netlist, as text or JSON on standard output.

#include <nlohmann/json_fwd.hpp>

#include "circuit/cost/cost.hpp"
#include "circuit/run_directives.hpp"
#include "circuit/variant/netlist_variants.hpp"
#include "cli/verb.hpp"

namespace corpuscle {

/// One variant of the netlist (a step of .step or a chip of .mc) and its results.
struct VariantResult {
    circuit::Variant variant;
    circuit::RunOutcome outcome;
    std::vector<circuit::Plot> plots;  ///< for the JSON document; with --out, without the points of transients, which are only in the file
    std::optional<circuit::Cost> cost = {};  ///< with --budget
};

/// The power, area and leakage of a circuit (--budget) as tables and, for an afferent, the number of afferents per area and per power.
std::string budget_tables(const circuit::Cost&);
/// Power and area in one line, for a netlist with several variants.
std::string budget_line(const circuit::Cost&);

/// Prints each variant when it is finished, and for .mc statistics at the end. With several variants, the JSON document is an array.
class VariantPrinter {
    const CommonArguments& common_;
    bool has_steps_, is_monte_carlo_;                                    // the netlist has several variants; it has .mc
    std::size_t count_ = 0;                                              // number of printed JSON documents
    std::vector<std::pair<std::string, std::vector<double>>> measured_;  // only for .mc: the names and values of all measurements

    void print_document(const nlohmann::ordered_json&);
    void print_statistics() const;

public:
    std::vector<Error> failures;              ///< errors of the variants that did not converge
    std::optional<Error> failed_expectation;  ///< the first expectation that was not met

    VariantPrinter(const CommonArguments& common, bool has_steps, bool is_monte_carlo)
        : common_(common), has_steps_(has_steps), is_monte_carlo_(is_monte_carlo) {}

    void add(const VariantResult&);
    /// Prints and counts a variant that did not converge.
    void fail(const std::string& label, const Error&);
    /// Ends the JSON array, or prints the statistics.
    void finish();
};

}  // namespace corpuscle
