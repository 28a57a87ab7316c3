// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/settings/settings_table.hpp"

namespace sks {

/// The table of sks::Settings.
const SettingsTable<Settings>& detectorTable();

}  // namespace sks
