// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>

#include "ros/configuration.hpp"

namespace sks_detector {

/// All changeable parameters with range, default, unit and help, in groups; choices as enumerations.
dynamic_reconfigure::ConfigDescription parameterDescriptions();

/// The values of all changeable parameters.
dynamic_reconfigure::Config toMessage(const Configuration& configuration);

/// `configuration` with the values of a message.
/// @param warnings takes a message for each old name
/// @throws sks::Error(bad_usage) for a name that is unknown, set twice or fixed while the node runs, or a value out of
///         range
Configuration overlaid(Configuration configuration, const dynamic_reconfigure::Config& message,
                       std::vector<std::string>& warnings);

}  // namespace sks_detector
