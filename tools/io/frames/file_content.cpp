// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/file_content.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kBeginningBytes = 4096;

struct Signature {
  std::string_view magic;
  std::size_t offset;
  FileContent content;
  const char* advice;  // of kForeign
};

constexpr const char* kGzip =
    translatable("this is a gzip archive; unpack it first: gunzip FILE, or tar xzf FILE where it holds files");
constexpr const char* kZip = translatable("this is a zip archive; unpack it first: unzip FILE");
constexpr const char* kBzip2 = translatable("this is a bzip2 archive; unpack it first: bunzip2 FILE");
constexpr const char* kXz = translatable("this is an xz archive; unpack it first: unxz FILE");
constexpr const char* kZstd = translatable("this is a zstd archive; unpack it first: unzstd FILE");
constexpr const char* kLz4 = translatable("this is an lz4 archive; unpack it first: unlz4 FILE");
constexpr const char* kSevenZip = translatable("this is a 7-Zip archive; unpack it first: 7z x FILE");
constexpr const char* kTar = translatable("this is a tar archive; unpack it first: tar xf FILE");
// PDAL writes text of two decimals unless it is told otherwise.
constexpr const char* kLas = translatable(
    "this is LAS or LAZ; PDAL makes a PCD of it: pdal translate FILE out.pcd --writers.pcd.compression=binary");
constexpr const char* kE57 =
    translatable("this is E57; PDAL makes a PCD of it: pdal translate FILE out.pcd --writers.pcd.compression=binary");
constexpr const char* kCloudCompare =
    translatable("this is a project of CloudCompare; save its cloud there as PLY: File > Save");
constexpr const char* kOldBag =
    translatable("this is a ROS 1 bag of an old format; rosbag fix or rosbag reindex makes 2.0 of it");
constexpr const char* kNumpy = translatable(
    "this is an array of NumPy; write its values alone, points.astype('<f4').tofile('frame.bin'), and read them with "
    "--layout");
constexpr const char* kHdf5 = translatable("this is HDF5; export its points as PCD, PLY or text");
constexpr const char* kUtf16 = translatable("this is text in UTF-16; UTF-8 and ASCII are read");
constexpr const char* kPicture = translatable("this is a picture, not a cloud of points");
constexpr const char* kPdf = translatable("this is a PDF document, not a cloud of points");

constexpr Signature kSignatures[] = {
    {"# .PCD"sv, 0, FileContent::kPcd, nullptr},
    {"ply\n"sv, 0, FileContent::kPly, nullptr},
    {"ply\r"sv, 0, FileContent::kPly, nullptr},
    {"#ROSBAG V2"sv, 0, FileContent::kRos1Bag, nullptr},
    {"#ROSBAG V1"sv, 0, FileContent::kForeign, kOldBag},
    {"#ROSRECORD"sv, 0, FileContent::kForeign, kOldBag},
    {"\x89MCAP"sv, 0, FileContent::kMcap, nullptr},
    {"SQLite format 3\0"sv, 0, FileContent::kSqlite, nullptr},
    {"\xD4\xC3\xB2\xA1"sv, 0, FileContent::kCapture, nullptr},
    {"\xA1\xB2\xC3\xD4"sv, 0, FileContent::kCapture, nullptr},
    {"\x4D\x3C\xB2\xA1"sv, 0, FileContent::kCapture, nullptr},
    {"\xA1\xB2\x3C\x4D"sv, 0, FileContent::kCapture, nullptr},
    {"\x0A\x0D\x0D\x0A"sv, 0, FileContent::kCapture, nullptr},
    {"\x1F\x8B\x08"sv, 0, FileContent::kForeign, kGzip},
    {"PK\x03\x04"sv, 0, FileContent::kForeign, kZip},
    {"BZh"sv, 0, FileContent::kForeign, kBzip2},
    {"\xFD"
     "7zXZ\0"sv,
     0, FileContent::kForeign, kXz},
    {"\x28\xB5\x2F\xFD"sv, 0, FileContent::kForeign, kZstd},
    {"\x04\x22\x4D\x18"sv, 0, FileContent::kForeign, kLz4},
    {"7z\xBC\xAF\x27\x1C"sv, 0, FileContent::kForeign, kSevenZip},
    {"ustar"sv, 257, FileContent::kForeign, kTar},
    {"LASF"sv, 0, FileContent::kForeign, kLas},
    {"ASTM-E57"sv, 0, FileContent::kForeign, kE57},
    {"CCB2"sv, 0, FileContent::kForeign, kCloudCompare},
    {"\x93NUMPY"sv, 0, FileContent::kForeign, kNumpy},
    {"\x89HDF\r\n"sv, 0, FileContent::kForeign, kHdf5},
    {"\xFF\xFE"sv, 0, FileContent::kForeign, kUtf16},
    {"\xFE\xFF"sv, 0, FileContent::kForeign, kUtf16},
    {"\x89PNG"sv, 0, FileContent::kForeign, kPicture},
    {"\xFF\xD8\xFF"sv, 0, FileContent::kForeign, kPicture},
    {"%PDF-"sv, 0, FileContent::kForeign, kPdf},
};

const Signature* signature_of(std::string_view beginning) {
  const auto fits = [beginning](const Signature& s) {
    const bool begins = beginning.size() > s.offset && beginning.substr(s.offset, s.magic.size()) == s.magic;
    // A mark of two bytes is too short: digits and letters in UTF-16 have a zero in every second byte.
    return begins && (s.advice != kUtf16 || beginning.substr(2, 2).find('\0') != std::string_view::npos);
  };
  const Signature* found = std::find_if(std::begin(kSignatures), std::end(kSignatures), fits);
  return found != std::end(kSignatures) ? found : nullptr;
}

// The first bytes of a signature and then the end of the file: a file that was cut there.
bool is_cut_signature(std::string_view beginning) {
  return std::any_of(std::begin(kSignatures), std::end(kSignatures), [beginning](const Signature& s) {
    return s.offset == 0 && s.magic.substr(0, beginning.size()) == beginning;
  });
}

// Capitals and small letters alike.
bool is_word(std::string_view word, std::string_view capitals) {
  return std::equal(word.begin(), word.end(), capitals.begin(), capitals.end(),
                    [](unsigned char c, char capital) { return std::toupper(c) == capital; });
}

// Others than PCL begin a header with comments of their own.
bool is_pcd_header(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
    if (is_word(word, "VERSION") || is_word(word, "FIELDS")) return true;
    if (!word.empty() && word.front() != '#') return false;
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return false;
}

bool is_text(std::string_view beginning) {
  const auto is_sign = [](unsigned char c) { return c >= 0x20 || c == '\n' || c == '\r' || c == '\t' || c == '\f'; };
  // Bytes above 0x7F are letters of UTF-8 in comments; values of points as floats have zeros among them.
  const auto is_high = [](unsigned char c) { return c >= 0x7F; };
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto high = std::count_if(beginning.begin(), beginning.end(), is_high);
  return std::all_of(beginning.begin(), beginning.end(), is_sign) &&
         std::any_of(beginning.begin(), beginning.end(), is_digit) &&
         4 * static_cast<std::size_t>(high) <= 3 * beginning.size();
}

}  // namespace

std::string beginning_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string beginning(kBeginningBytes, '\0');
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(stream.gcount()));
  return beginning;
}

FileContent content_of(std::string_view beginning) {
  if (beginning.empty()) return FileContent::kEmpty;
  if (const Signature* found = signature_of(beginning)) return found->content;
  if (is_cut_signature(beginning)) return FileContent::kUnknown;
  if (is_pcd_header(beginning)) return FileContent::kPcd;
  return is_text(beginning) ? FileContent::kText : FileContent::kUnknown;
}

std::string content_name(FileContent content) {
  switch (content) {
    case FileContent::kPcd:
      return "PCD";
    case FileContent::kPly:
      return "PLY";
    case FileContent::kText:
      return tr("text");
    case FileContent::kRos1Bag:
      return tr("a ROS 1 bag");
    case FileContent::kMcap:
      return tr("an MCAP bag");
    case FileContent::kSqlite:
      return tr("an SQLite bag of ROS 2");
    case FileContent::kCapture:
      return tr("a capture of packets");
    default:
      return "";
  }
}

std::string foreign_advice(std::string_view beginning) {
  const Signature* found = signature_of(beginning);
  return found != nullptr && found->advice != nullptr ? tr(found->advice) : "";
}

bool ending_decides(FileContent content) {
  return content == FileContent::kEmpty || content == FileContent::kUnknown;
}

}  // namespace pose_wall::tools
