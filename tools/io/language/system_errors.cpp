// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/language/system_errors.hpp"

#include <system_error>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// The C library's words, as it writes them in the locale C, which this program never leaves.
[[maybe_unused]] constexpr const char* kErrors[] = {
    translatable("No such file or directory"),
    translatable("Permission denied"),
    translatable("Is a directory"),
    translatable("Not a directory"),
    translatable("File exists"),
    translatable("No space left on device"),
    translatable("Read-only file system"),
    translatable("Input/output error"),
    translatable("Too many open files"),
    translatable("File name too long"),
    translatable("Operation not permitted"),
    translatable("Device or resource busy"),
    translatable("Address already in use"),
    translatable("Cannot assign requested address"),
    translatable("Connection refused"),
    translatable("No route to host"),
    translatable("Network is unreachable"),
    translatable("Network is down"),
    translatable("Address family not supported by protocol"),
};

}  // namespace

std::string system_error_text(int error) {
  return tr(std::generic_category().message(error).c_str());
}

}  // namespace pose_wall::tools
