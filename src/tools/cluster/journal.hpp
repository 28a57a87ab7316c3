// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "core/sharing/work_share.hpp"

namespace sks::tools {

/// A file to which the result of each item is added as soon as it is there, so that a run which was ended goes on with
/// the rest. Each line begins with the CRC-32C of what follows; from the first one that is not whole on, all is cut
/// off. The first line tells of which work the results are.
class Journal {
public:
  /// @param work any text without line ends that is another one for other results
  /// @throws Error(bad_file) where it cannot be read or written, or another run writes it; Error(bad_usage) for a file
  /// of other work, and for one
  ///         that is none, which stays as it is
  Journal(const std::string& path, const std::string& work);
  /// Results by item.
  const std::map<std::size_t, std::string>& known() const { return known_; }
  /// @throws Error(bad_file)
  void add(std::size_t item, const std::string& result);
  /// To be called when all results are where they belong.
  void remove();

private:
  void addLine(const std::string& text);
  [[noreturn]] void fail(const std::string& reason) const;

  /// Closes it, which also unlocks it.
  struct OpenFile {
    explicit OpenFile(int file) : descriptor(file) {}
    ~OpenFile();
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    int descriptor;  // negative: it could not be opened
  };

  std::string path_;
  OpenFile file_;
  std::map<std::size_t, std::string> known_;
};

/// Work of which the journal of the leader knows a part: that is not done again, and what is new is added.
class JournaledShare : public WorkShare {
public:
  /// @param share that does the rest; null: this process alone @param journal null where this process does not lead
  JournaledShare(WorkShare* share, Journal* journal) : share_(share), journal_(journal) {}

  bool leads() const override { return share_ == nullptr || share_->leads(); }
  void deal(std::size_t count, const Work& work, const Take& take, const Report& report) override;
  void spread(std::string& bytes) override {
    if (share_ != nullptr) share_->spread(bytes);
  }

private:
  WorkShare* share_;
  Journal* journal_;
};

}  // namespace sks::tools
