// The named afferents. Each row has the members of NamedAfferent in order: name, receptor, neuron, parameters that differ from the defaults
// of these models, aliases, description, source, front end.

#include "model/catalog.hpp"

namespace corpuscle {

const std::vector<NamedAfferent>& named_afferents() {
    static const std::vector<NamedAfferent> all = {
        {"sa1",
         "sa1b",
         "lif-b",
         {},
         {"sa-i", "sai"},
         "slowly adapting type I: fires while the force rises and, at a falling rate, while it is held",
         "thesis 3.3, fig. 17"},
        {"fa1",
         "fa1b",
         "lif-b",
         {{"I_leak0", 1e-6}},
         {"fa-i", "fai", "ra", "ra1"},
         "fast adapting type I: fires while the force rises and while it falls",
         "thesis 3.4, fig. 18"},
        {"sa2",
         "sa1a",
         "lif-b",
         {{"k_s", 2e-6}, {"k_d", 30e-9}},
         {"sa-ii"},
         "slowly adapting type II: fires steadily while the force is held; responds to release as to touch",
         "SA-IA used as SA-II, as thesis 3.1 suggests; values are a choice"},
        {"fa2",
         "vibration",
         "lif-b",
         {{"C_m", 100e-9}, {"I_leak0", 1e-6}},
         {"fa-ii", "pc"},
         "fast adapting type II: vibration, best at 200 to 300 Hz; does not respond to slow force",
         "choice, after the tuning of PC afferents in PMC2657072, table 1"},
        {"sa1-kim",
         "sa1a",
         "lif-a",
         {},
         {},
         "the earlier digital SA-I: SA-IA with LIF-A, in fixed point behind a sensor and a converter",
         "Kim et al. 2012 as described in thesis 3.1; values are a choice",
         "fsr+f2v+adc"},
        {"fa1-lee",
         "fa1a",
         "adaptive",
         {{"k", 200e-9}},
         {},
         "the earlier digital FA-I: one neuron for rising and one for falling force, adaptive threshold; also in fixed point",
         "Lee et al. 2016 as described in thesis 3.1; values are a choice",
         "fsr+f2v+adc"},
    };
    return all;
}

}  // namespace corpuscle
