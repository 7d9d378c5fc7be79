#pragma once
// The public interface of Corpuscle: name an afferent, pass a force, get spikes; or read a netlist, analyse it, get curves.

#include "corpuscle/catalogue.hpp"
#include "corpuscle/circuit.hpp"
#include "corpuscle/compare.hpp"
#include "corpuscle/fit.hpp"
#include "corpuscle/force.hpp"
#include "corpuscle/live.hpp"
#include "corpuscle/measures.hpp"
#include "corpuscle/model_export.hpp"
#include "corpuscle/nir.hpp"
#include "corpuscle/nwb.hpp"
#include "corpuscle/respond.hpp"
#include "corpuscle/spikes.hpp"
#include "corpuscle/sweep.hpp"
#include "corpuscle/trials.hpp"
