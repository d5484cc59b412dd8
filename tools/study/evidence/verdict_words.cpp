// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/evidence/verdict_words.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "io/json/json_words.hpp"
#include "io/language/language.hpp"
#include "io/terminal/text_table.hpp"
#include "study/info/wide_text.hpp"

namespace pose_wall::tools::evidence {
namespace {

constexpr std::array<const char*, 4> kStateWords = {"same", "changed", "missing", "unreadable"};
constexpr std::array<const char*, 4> kStateTexts = {translatable("as packed"), translatable("changed"),
                                                    translatable("not there"), translatable("damaged")};
constexpr std::array<const char*, 5> kSignatureWords = {"none", "own_key", "site", "other", "wrong"};

std::string paragraph(const std::string& text) {
  return wrapped(text, 0, kLineWidth);
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + shown_name(word);
  return text;
}

std::string why_text(const std::string& why) {
  constexpr std::array<const char*, 5> kWhys = {translatable("hidden"), translatable("link"), translatable("folder"),
                                                translatable("no regular file"), translatable("the zip itself")};
  for (const char* known : kWhys) {
    if (why == known) return tr(known);
  }
  return shown_name(why);
}

std::string settings_text(const Manifest& manifest) {
  if (!manifest.settings) return "";
  std::string text =
      say("CRC of the settings: 16#{:08X} (dwConfigCrc of FB_PoseWall)", manifest.settings->config_crc32);
  if (manifest.settings->planar_stop_crc32) {
    text += "\n" + say("CRC of the obstacle stop's settings: 16#{:08X} (dwSettingsCrc of FB_PoseWallStop)",
                       *manifest.settings->planar_stop_crc32);
  }
  text += "\n";
  if (manifest.settings->extrinsic_from != "tf") return text;
  return text +
         paragraph(tr("The mounting comes from tf (extrinsic_from). On the machine the CRCs count it, too, and are "
                      "others."));
}

std::string about_text(const Manifest& manifest) {
  std::string text =
      say("Packed at {} by pose_wall {}.\n", shown_name(manifest.made_at), shown_name(manifest.version)) +
      settings_text(manifest);
  if (!manifest.missing.empty()) text += paragraph(say("Usual parts that are missing: {}.", listed(manifest.missing)));
  std::vector<std::string> left_out;
  for (const LeftOut& left : manifest.left_out) left_out.push_back(left.name + " (" + why_text(left.why) + ")");
  if (!left_out.empty()) text += paragraph(say("Left out of the folder: {}.", listed(left_out)));
  return text;
}

std::string signature_text(const Verdict& verdict, bool has_site_key) {
  switch (verdict.signature) {
    case Signature::kNone:
      return tr("Nothing proves who made it: it has no signature.");
    case Signature::kOwnKey:
      return say(
          "Signed by the key in the zip itself, fingerprint {}. Anybody can put a key of his own there: compare the "
          "fingerprint with the site's, or give --public-key.",
          verdict.signer_sha256);
    case Signature::kSite:
      return say("Signed by the site: the given key, fingerprint {}.", verdict.signer_sha256);
    case Signature::kOther:
      return say("Not signed by the given key, but by another one, fingerprint {}.", verdict.signer_sha256);
    default:
      return has_site_key ? tr("The signature is wrong: the site did not sign this.")
                          : tr("The signature is wrong: nobody signed this.");
  }
}

std::string limits_text(bool is_whole) {
  if (!is_whole) return "";
  return paragraph(
      tr("Not proven: when it was packed (the time is that of the packing machine's clock), that nothing was left out "
         "before, and that the files tell the truth of the machine."));
}

Json files_json(const Verdict& verdict) {
  Json files = Json::array();
  for (const CheckedFile& file : verdict.files) {
    files.push_back({{"name", file.told.name},
                     {"bytes", file.told.bytes},
                     {"sha256", file.told.sha256},
                     {"state", kStateWords[static_cast<std::size_t>(file.state)]}});
  }
  return files;
}

}  // namespace

bool is_proven(const Verdict& verdict, bool has_site_key) {
  return verdict.is_whole() && (!has_site_key || verdict.signature == Signature::kSite);
}

std::string packed_text(const std::string& zip, const Manifest& manifest) {
  TextTable table({tr("file"), tr("bytes"), "SHA-256"});
  for (const PackedFile& file : manifest.files) table.add_row({file.name, std::to_string(file.bytes), file.sha256});
  std::string text = zip + "\n" + table.text(1) + "\n" + about_text(manifest);
  if (!manifest.signed_by) {
    return text + paragraph(tr("Nothing proves who made it: no key was given (--key). Whoever changes a file can make "
                               "the manifest anew."));
  }
  return text + paragraph(say("Signed by the key with the fingerprint {}. Keep it, or {}, where nobody can change it: "
                              "who checks needs one of them from another way than the zip.",
                              *manifest.signed_by, kPublicKeyName));
}

std::string verdict_text(const std::string& zip, const Verdict& verdict, bool has_site_key) {
  std::string text = zip + "\n";
  if (verdict.has_manifest) {
    TextTable table({tr("file"), tr("bytes"), tr("state")});
    for (const CheckedFile& file : verdict.files) {
      table.add_row(
          {file.told.name, std::to_string(file.told.bytes), tr(kStateTexts[static_cast<std::size_t>(file.state)])});
    }
    text += table.text(1) + "\n" + about_text(verdict.manifest);
  }
  if (verdict.is_whole()) {
    text += paragraph(tr("Whole: every file is as its manifest tells, and there is no other."));
  } else {
    text += say("NOT WHOLE:\n");
    for (const std::string& fault : verdict.faults) text += wrapped("- " + fault, 0, kLineWidth);
  }
  return text + paragraph(signature_text(verdict, has_site_key)) + limits_text(verdict.is_whole());
}

std::string verdict_json(const std::string& zip, const Verdict& verdict, bool has_site_key) {
  Json json;
  json["file"] = zip;
  json["proven"] = is_proven(verdict, has_site_key);
  json["whole"] = verdict.is_whole();
  json["signature"] = kSignatureWords[static_cast<std::size_t>(verdict.signature)];
  json["signer_sha256"] = verdict.signer_sha256.empty() ? Json(nullptr) : Json(verdict.signer_sha256);
  json["faults"] = verdict.faults;
  json["files"] = files_json(verdict);
  json["manifest"] = verdict.has_manifest ? Json::parse(manifest_text(verdict.manifest)) : Json(nullptr);
  return json_text(json, 2) + "\n";
}

}  // namespace pose_wall::tools::evidence
