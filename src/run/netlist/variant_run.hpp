#pragma once
// Runs a netlist: its overrides and probes, then the analyses of all of its variants.

#include "circuit/run_directives.hpp"
#include "circuit/variant/analysis_selection.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "circuit/variant/netlist_variants.hpp"

namespace corpuscle {

/// The changes of a netlist that a user requests.
struct NetlistChanges {
    std::vector<ParameterOverride> overrides = {};  ///< all for this netlist
    std::vector<std::string> probes = {};           ///< recorded in addition to those of the netlist
};

/// The changed netlist that `open` reads. `name`: of the netlist, for messages. `probe_option`: what precedes a probe in a message,
/// "--probe ".
Result<circuit::Netlist> change_netlist(const circuit::NetlistOpener& open, const std::string& name, const NetlistChanges&,
                                        std::string_view probe_option);

/// Receives the variants of a netlist.
class VariantHandler {
public:
    virtual ~VariantHandler() = default;
    /// Called before a variant is run. Returns the options of its run without should_stop.
    virtual Result<circuit::RunOptions> begin(const circuit::Variant&, circuit::AnalysisContext&) = 0;
    virtual Result<void> end(const circuit::Variant&, circuit::RunOutcome&&) = 0;
    /// Called instead of end() for a variant that did not converge, unless it is the only one, which is an error of the run.
    virtual void fail(const circuit::Variant&, const Error&) = 0;
};

/// Runs all variants in order, with all analyses of the netlist or with the selected one. `should_continue` is called often with the
/// completed fraction, 0 to 1. If it returns false, the run ends with an error `interrupted`.
Result<void> run_variants(circuit::NetlistVariants&, const std::optional<circuit::AnalysisSelection>&, VariantHandler&,
                          const std::function<bool(double fraction)>& should_continue);

/// The error of a run of `count` variants of which some did not converge, `failures`.
Error error_of_failures(const std::vector<Error>& failures, std::size_t count);

/// Returns an error for the first expectation that is not met. `label`: of the variant.
Result<void> check_expectations_met(const circuit::RunOutcome&, std::string_view label);

}  // namespace corpuscle
