// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/registration.hpp>
#include <sks_detector/trainer.hpp>

#include "core/sharing/work_share.hpp"

namespace sks {

/// train(), by the processes of a share where one is given: the same codebook, whatever their number. Each process
/// loads what it is dealt. Only the leader's result is whole.
Codebook train(const std::vector<TrainingSample>& samples, const Settings& settings, const std::string& name,
               const Progress& progress, const Stages& stages, WorkShare* share);

/// registerViews(), an object at a time by the processes of a share. All get the whole result.
ViewRegistration registerViews(const std::vector<TrainingSample>& samples, const Settings& settings,
                               const Progress& progress, const Stages& stages, WorkShare* share);

/// trainRegistered(), in the same way. Only the leader's result is whole.
RegisteredTraining trainRegistered(const std::vector<TrainingSample>& samples, const Settings& settings,
                                   const std::string& name, const Progress& progress, const Stages& stages,
                                   WorkShare* share);

}  // namespace sks
