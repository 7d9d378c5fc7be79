#pragma once
// Makes and describes the afferents that are equations.

#include "core/afferent_factory.hpp"

namespace corpuscle {

/// The factory of all plans that are made of components of the catalogue.
std::shared_ptr<const AfferentFactory> model_factory();

}  // namespace corpuscle
