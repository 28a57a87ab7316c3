// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sks {

/// Entries by key, those of one key in their order, whatever the number of threads: each counts its part of them and
/// puts it in its slots. Takes the same time whatever the keys are.
/// @param keys one more than the largest key @param key_of the key of an entry
/// @param begin becomes the slot of each key's first entry, and one past the last of all
template <typename Entry, typename KeyOf>
std::vector<Entry> sortedByKey(const std::vector<Entry>& entries, std::size_t keys, KeyOf&& key_of, int threads,
                               std::vector<std::uint32_t>& begin) {
  const std::size_t n = entries.size(), parts = std::clamp<std::size_t>(n / keys, 1, std::size_t(threads));
  std::vector<std::uint32_t> next(parts * keys, 0);
  const auto forEachOfPart = [&](std::size_t part, auto&& f) {
    for (std::size_t i = n * part / parts; i < n * (part + 1) / parts; ++i) {
      f(entries[i], next[part * keys + key_of(entries[i])]);
    }
  };
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t part = 0; part < parts; ++part) {
    forEachOfPart(part, [](const Entry&, std::uint32_t& count) { ++count; });
  }
  begin.resize(keys + 1);
  std::uint32_t slot = 0;
  for (std::size_t key = 0; key < keys; ++key) {
    begin[key] = slot;
    for (std::size_t part = 0; part < parts; ++part) {
      slot += std::exchange(next[part * keys + key], slot);
    }
  }
  begin[keys] = slot;
  std::vector<Entry> sorted(n);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t part = 0; part < parts; ++part) {
    forEachOfPart(part, [&](const Entry& entry, std::uint32_t& to) { sorted[to++] = entry; });
  }
  return sorted;
}

}  // namespace sks
