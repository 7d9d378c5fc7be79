#pragma once
// The studies by name. A new one: its file in studies/, and its name here.

#include "study/study.hpp"

namespace corpuscle {

Result<Outcome> study_classes(const StudyOptions&);
Result<Outcome> study_earlier(const StudyOptions&);
Result<Outcome> study_range(const StudyOptions&);
Result<Outcome> study_resolution(const StudyOptions&);
Result<Outcome> study_kim(const StudyOptions&);
Result<Outcome> study_nerve(const StudyOptions&);

inline constexpr Study studies[] = {
    {"classes", "The four classes of the skin under a step", "Which fire at the step, which through the hold? Thesis fig. 3",
     study_classes},
    {"earlier", "The two digital systems that came before, and the thesis's models, under the press",
     "What do Kim's and Lee's systems answer where the thesis's models answer? Thesis 2.2, 3.1", study_earlier},
    {"range", "Where the chips work: supply, temperature, corners of the process",
     "Between which supplies and temperatures do the two chips fire as they should under the press, and what stops them? Thesis E.2",
     study_range},
    {"resolution", "Bits and rate of a digital afferent, and the time of its spikes",
     "How many bits and how many samples a second does the mixed-signal way need? Thesis 1.3, fig. 6a", study_resolution},
    {"kim", "Kim's ramp and hold", "Can his equation give the intervals he printed? Kim et al. 2012, doi 10.1186/1743-0003-9-45",
     study_kim},
    {"nerve", "What is known of the nerve", "Rates, adaptation and entrainment against the literature", study_nerve},
};

}  // namespace corpuscle
