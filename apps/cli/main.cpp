// The program corpuscle: its verbs and the text of its help.

#include "cli/verbs.hpp"

namespace {

constexpr const char* about = "Corpuscle: artificial touch. Force goes in, nerve-like spikes come out.";

constexpr const char* first_steps = R"(First steps:
  corpuscle respond press                                press, hold and release, through an SA-I and an FA-I afferent
  corpuscle respond press --report press.html            the same, with a report page
  corpuscle respond press --afferent sa1,sa1-circuit     a model beside its transistor circuit
  corpuscle respond touch.csv --unit mN --out result     your own recording: spikes.csv, summary.json
  corpuscle compare result/spikes.csv other/spikes.csv   how two responses differ
  corpuscle run circuits/inverter.cir                    run the analyses of a netlist
  corpuscle export circuits/inverter.cir --for ngspice   the same netlist for another simulator
  corpuscle sweep chips.toml                             Monte Carlo, corners and grids (see sweep --help)
  corpuscle stream --population hand --rate 1kHz         live: force in, spikes out
  corpuscle study --report studies.html                  reproduce published results
  corpuscle list                                         every afferent, stimulus and parameter

Exit status: 0 success, 1 bad input, 2 bad usage, 3 did not converge, 130 interrupted.)";

}  // namespace

int main(int argc, char** argv) { return corpuscle::run_program(about, first_steps, corpuscle::make_verbs(), argc, argv); }
