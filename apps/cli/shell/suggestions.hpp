#pragma once
// Names of the catalogues, which a shell offers for the options and arguments of verbs.

#include <string>
#include <vector>

namespace corpuscle {

std::vector<std::string> afferent_names();
std::vector<std::string> population_names();       ///< skins
std::vector<std::string> live_population_names();  ///< skins and afferents
std::vector<std::string> indenter_names();
std::vector<std::string> stimulus_names();
std::vector<std::string> force_names();      ///< stimuli and touches of a skin
std::vector<std::string> setting_names();    ///< "sa1.f_B=", of afferents, stimuli and contacts
std::vector<std::string> netlist_names();    ///< the embedded ones
std::vector<std::string> catalogue_names();  ///< the catalogues and their entries
std::vector<std::string> measure_names();

}  // namespace corpuscle
