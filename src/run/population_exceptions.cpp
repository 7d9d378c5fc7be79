#include "run/population_exceptions.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>

namespace corpuscle {
namespace {

constexpr std::string_view in_file = "the population defines the afferents of a skin and how they vary",
                           own_file = "write a population file (doc/skin.md)", models = "the afferents of a skin are models, not netlists",
                           run_netlist = "run a netlist with --afferent sa1-circuit, without --population";

constexpr PopulationException exceptions[] = {
    {PopulationKind::skin, "--afferent", in_file, own_file},
    {PopulationKind::skin, "--copies", in_file, own_file},
    {PopulationKind::skin, "--spread", in_file, own_file},
    {PopulationKind::skin, "copies.csv", in_file, "afferents.csv has a row for each afferent"},
    {PopulationKind::skin, "--by", "a skin is simulated under one force", "extract one trial, or use --trials with a table of times"},
    {PopulationKind::skin, "--noise", "membranes of a skin have no noise", "for a noisy force use press+noise as FORCE"},
    {PopulationKind::skin, "--float", "a skin is simulated in double precision only", "remove --float"},
    {PopulationKind::skin, "--vectors", "afferents of a skin have no converter",
     "run an afferent with one: --afferent sa1-kim, without --population"},
    {PopulationKind::skin, "--corner", models, run_netlist},
    {PopulationKind::skin, "--mismatch", models, run_netlist},
    {PopulationKind::skin, "--probe", models, run_netlist},
    {PopulationKind::skin, "--supply", models, run_netlist},
    {PopulationKind::skin, "--temp", models, run_netlist},
    {PopulationKind::channels, "--contact", "an indenter presses on a skin", "name one, such as --population hand"},
    {PopulationKind::channels, "--taxels", "taxels are on a skin", "name one, such as --population hand"},
    {PopulationKind::channels, "--checkpoint", "only the run of a skin can be resumed", "remove --checkpoint, or name a --population"},
    {PopulationKind::channels, "afferents.csv", "a channel has no afferents with positions and delays",
     "summary.json has the measures of every afferent, copies.csv those of every copy"},
};

}  // namespace

std::span<const PopulationException> population_exceptions() { return exceptions; }

const PopulationException* find_exception(PopulationKind population, std::string_view option) {
    const auto at = std::find_if(std::begin(exceptions), std::end(exceptions),
                                 [&](const PopulationException& e) { return e.population == population && e.option == option; });
    return at == std::end(exceptions) ? nullptr : at;
}

Error exception_error(const PopulationException& e) {
    return bad_usage(fmt::format("{} cannot be used {} --population: {}; {}", e.option,
                                 e.population == PopulationKind::skin ? "with" : "without", e.reason, e.remedy));
}

}  // namespace corpuscle
