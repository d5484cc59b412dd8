// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/evidence/zip_file.hpp"

#include <zip.h>

#include <stdexcept>

#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"
#include "io/terminal/interrupt.hpp"
#include "study/evidence/evidence.hpp"

namespace pose_wall::tools::evidence {
namespace {

using Done = std::function<void(double)>;

std::string error_text(int code) {
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

[[noreturn]] void refuse_write(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error(say("{}: cannot be written{}", file.string(), ": " + why));
}

void add_member(zip_t* zip, const std::filesystem::path& file, const NewMember& member) {
  zip_source_t* const source = member.file.empty() ? zip_source_buffer(zip, member.bytes.data(), member.bytes.size(), 0)
                                                   : zip_source_file(zip, member.file.c_str(), 0, -1);
  const zip_int64_t index = source == nullptr ? -1 : zip_file_add(zip, member.name.c_str(), source, ZIP_FL_ENC_UTF_8);
  const auto method = static_cast<zip_int32_t>(member.deflates ? ZIP_CM_DEFLATE : ZIP_CM_STORE);
  if (index >= 0 && zip_set_file_compression(zip, static_cast<zip_uint64_t>(index), method, 0) == 0) return;
  if (index < 0) zip_source_free(source);
  refuse_write(file, zip_strerror(zip));
}

// Nothing may be thrown through libzip, which asks is_cancelled() next.
void tell_share(zip_t* /*zip*/, double share, void* done) {
  try {
    (*static_cast<const Done*>(done))(share);
  } catch (const Interrupted&) {
    return;
  }
}

int is_cancelled(zip_t* /*zip*/, void* /*nothing*/) {
  return InterruptWatch::is_interrupted() ? 1 : 0;
}

}  // namespace

void write_zip(const std::filesystem::path& file, const std::vector<NewMember>& members, const Done& done) {
  int code = 0;
  // Given back by close or, where that fails, thrown away: libzip writes beside the file and renames as the last step.
  std::unique_ptr<zip_t, void (*)(zip_t*)> zip(zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code), zip_discard);
  if (!zip) refuse_write(file, error_text(code));
  for (const NewMember& member : members) add_member(zip.get(), file, member);
  constexpr double kShareStep = 0.001;
  Done told = done;
  zip_register_progress_callback_with_state(zip.get(), kShareStep, tell_share, nullptr, &told);
  zip_register_cancel_callback_with_state(zip.get(), is_cancelled, nullptr, nullptr);
  if (zip_close(zip.get()) != 0) {
    stop_if_interrupted();
    refuse_write(file, zip_strerror(zip.get()));
  }
  static_cast<void>(zip.release());
  // A name must not be that of bytes which a power cut takes.
  if (const std::error_code error = sync_to_disk(file)) refuse_write(file, system_error_text(error.value()));
}

ZipReader::ZipReader(const std::filesystem::path& file) : zip_(nullptr, zip_discard) {
  int code = 0;
  zip_.reset(zip_open(file.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &code));
  if (!zip_) throw std::runtime_error(error_text(code));
  const zip_int64_t count = zip_get_num_entries(zip_.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    zip_stat_t about;
    zip_stat_init(&about);
    const char* const name = zip_get_name(zip_.get(), index, ZIP_FL_ENC_RAW);
    if (name == nullptr || zip_stat_index(zip_.get(), index, 0, &about) != 0) {
      throw std::runtime_error(zip_strerror(zip_.get()));
    }
    const bool is_plain = (about.comp_method == ZIP_CM_STORE || about.comp_method == ZIP_CM_DEFLATE) &&
                          about.encryption_method == ZIP_EM_NONE;
    members_.push_back({name, about.size, about.comp_size, is_plain});
  }
}

bool ZipReader::read(std::size_t index, const std::function<void(const char*, std::size_t)>& take) const {
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(zip_.get(), index, 0), zip_fclose);
  if (!file) return false;
  std::vector<char> chunk(kChunkBytes);
  std::uint64_t left = members_[index].bytes;
  // Once more at the end: there libzip compares sizes and checksum.
  for (;;) {
    const zip_int64_t got = zip_fread(file.get(), chunk.data(), chunk.size());
    if (got < 0 || static_cast<std::uint64_t>(got) > left) return false;
    if (got == 0) return left == 0;
    take(chunk.data(), static_cast<std::size_t>(got));
    left -= static_cast<std::uint64_t>(got);
  }
}

}  // namespace pose_wall::tools::evidence
