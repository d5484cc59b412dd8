// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall evidence: a folder of a commissioning as one zip that proves itself, and the check of such a zip.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include "apps/options/one_of.hpp"
#include "apps/verbs/complaint.hpp"
#include "apps/verbs/verbs.hpp"
#include "io/language/language.hpp"
#include "io/terminal/interrupt.hpp"
#include "io/terminal/progress_bar.hpp"
#include "study/evidence/evidence.hpp"
#include "study/evidence/open_key.hpp"
#include "study/evidence/verdict_words.hpp"

namespace pose_wall::tools {
namespace {

struct EvidenceOptions {
  std::string folder, output, key;
  std::string zip, public_key;
  std::string format = "table";
  bool force = false, quiet = false;

  bool is_json() const { return format == "json"; }
};

// One bar for all that is read, packed and checked.
class Bar {
 public:
  explicit Bar(bool is_quiet) : is_shown_(!is_quiet && is_terminal(2)) {}

  evidence::Step begin(std::uint64_t chunks) {
    bar_ = std::make_unique<ProgressBar>(chunks, is_shown_, translatable("MB"));
    return [this](const std::string& name) {
      stop_if_interrupted();
      bar_->advance(name);
    };
  }
  void end() { bar_.reset(); }

 private:
  bool is_shown_;
  std::unique_ptr<ProgressBar> bar_;
};

void expect_pack_words(const EvidenceOptions& options) {
  if (options.folder.empty()) throw std::invalid_argument(tr("FOLDER is missing, or --verify FILE.zip"));
  if (options.output.empty()) throw std::invalid_argument(tr("--output FILE.zip is missing"));
  if (!options.public_key.empty()) throw std::invalid_argument(tr("--public-key goes with --verify; --key signs"));
}

void expect_verify_words(const EvidenceOptions& options) {
  if (options.folder.empty() && options.output.empty() && options.key.empty() && !options.force) return;
  throw std::invalid_argument(tr("--verify goes with --public-key and --format alone"));
}

int pack(const EvidenceOptions& options) {
  expect_pack_words(options);
  if (!options.quiet && !options.key.empty() && evidence::is_open_to_others(options.key)) {
    fmt::print(stderr, "pose_wall evidence: {}",
               say("warning: {} can be read by others, who can then sign as the site: chmod 600 {}\n", options.key,
                   options.key));
  }
  Bar bar(options.quiet);
  const evidence::Manifest manifest = evidence::pack({options.folder, options.output, options.force, options.key},
                                                     [&bar](std::uint64_t chunks) { return bar.begin(chunks); });
  bar.end();
  fmt::print("{}", options.is_json() ? manifest_text(manifest) : packed_text(options.output, manifest));
  return kExitDone;
}

int verify(const EvidenceOptions& options) {
  expect_verify_words(options);
  Bar bar(options.quiet);
  const evidence::Verdict verdict =
      evidence::verify(options.zip, options.public_key, [&bar](std::uint64_t chunks) { return bar.begin(chunks); });
  bar.end();
  const bool has_key = !options.public_key.empty();
  fmt::print("{}", options.is_json() ? verdict_json(options.zip, verdict, has_key)
                                     : verdict_text(options.zip, verdict, has_key));
  return is_proven(verdict, has_key) ? kExitDone : kExitUnreadable;
}

int run_evidence(const EvidenceOptions& options) {
  if (options.is_json()) choose_language(Language::kEnglish);  // programs read it
  return done_or_complaint("evidence", [&] { return options.zip.empty() ? pack(options) : verify(options); });
}

constexpr const char* kFooter = translatable(
    "Examples:\n  openssl genpkey -algorithm ed25519 -out site.pem && chmod 600 site.pem\n"
    "  openssl pkey -in site.pem -pubout -out site.pub.pem\n"
    "  pose_wall evidence commissioning -o evidence.zip --key site.pem\n"
    "  pose_wall evidence --verify evidence.zip --public-key site.pub.pem\n"
    "Exit status: 0 packed, or proven whole and, with --public-key, signed by the site; 1 a file cannot be read or\n"
    "written, or the zip is damaged, forged, or not signed by that key; 2 bad usage, key or settings; 130 "
    "interrupted.");

}  // namespace

void add_evidence(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<EvidenceOptions>();
  CLI::App* verb = app.add_subcommand("evidence", tr("Pack a folder of a commissioning as a signed zip, or check one"));
  verb->add_option("FOLDER", options->folder,
                   tr("Its files are packed: settings.yaml, doctor.json, report.html, recordings, and all others. "
                      "Hidden files, links and folders are named and left out"));
  verb->add_option("-o,--output", options->output, tr("The zip; it is there whole or not at all"))
      ->type_name("FILE.zip");
  verb->add_option("--key", options->key, tr("Private key of the site, Ed25519 in PEM: signs the manifest"))
      ->check(existing_file())
      ->type_name("FILE.pem");
  verb->add_flag("--force", options->force, tr("Overwrite --output"));
  verb->add_option("--verify", options->zip, tr("Check this zip instead: hashes, names, sizes, signature"))
      ->check(existing_file())
      ->type_name("FILE.zip");
  verb->add_option("--public-key", options->public_key,
                   tr("With --verify: the site's public key, from another way than the zip"))
      ->check(existing_file())
      ->type_name("FILE.pem");
  verb->add_option("--format", options->format, tr("A table, or JSON: the manifest, or the verdict"))
      ->check(one_of({"table", "json"}))
      ->capture_default_str();
  verb->add_flag("-q,--quiet", options->quiet, tr("Nothing on stderr but errors"));
  verb->footer(tr(kFooter));
  verb->callback([options, &exit_code] { exit_code = run_evidence(*options); });
}

}  // namespace pose_wall::tools
