#pragma once
// Makes and describes the afferents of all plans that are made of components of the catalogue.

#include "core/afferent_factory.hpp"

namespace corpuscle {

std::shared_ptr<const AfferentFactory> model_factory();

}  // namespace corpuscle
