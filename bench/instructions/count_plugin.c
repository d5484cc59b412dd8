/* SPDX-License-Identifier: BSD-3-Clause
 * Copyright (c) 2026 the pose_wall authors
 *
 * A plugin for qemu-user (7.2): counts the guest's instructions and writes the count at every getppid(), which the
 * guest calls as a mark. The same to the instruction over runs and machines, where times are not. With the argument
 * functions=on it also writes, before each mark, a line "function instructions" for each function that has run since
 * the mark before: what the compiler has inlined is counted where it stands.
 *
 * Debian does not ship qemu-plugin.h. What is used of it is declared here, after "QEMU TCG Plugins" in QEMU's developer
 * documentation, plugin API version 1.
 */

#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#define EXPORTED __attribute__((visibility("default")))

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb; /* a block of translated instructions */
struct qemu_plugin_insn;

typedef void (*block_callback)(qemu_plugin_id_t, struct qemu_plugin_tb*);
typedef void (*call_callback)(qemu_plugin_id_t, unsigned cpu, int64_t number, uint64_t, uint64_t, uint64_t, uint64_t,
                              uint64_t, uint64_t, uint64_t, uint64_t);

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, block_callback callback);
void qemu_plugin_register_vcpu_syscall_cb(qemu_plugin_id_t id, call_callback callback);
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb* block, int operation, void* counter, uint64_t by);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* block);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb* block, size_t index);
const char* qemu_plugin_insn_symbol(const struct qemu_plugin_insn* instruction);
void qemu_plugin_outs(const char* text);

enum { kAddToCounter = 0, kGetppidOnAArch64 = 173 };

EXPORTED int qemu_plugin_version = 1;
EXPORTED int qemu_plugin_install(qemu_plugin_id_t id, const void* info, int argc, char** argv);

enum { kFunctionsMax = 8192, kNameMax = 512 };

static uint64_t instructions;
static int by_function;
/* The names are the emulator's own and stay as long as it runs: the same function has the same pointer. */
static struct {
  const char* name;
  uint64_t instructions, before;
} functions[kFunctionsMax];
static size_t function_count;

/* Of the function that the block begins in; the last place is for all that have none. */
static uint64_t* counter_of(const struct qemu_plugin_tb* block) {
  const char* const name = qemu_plugin_insn_symbol(qemu_plugin_tb_get_insn(block, 0));
  size_t k = 0;
  while (k < function_count && functions[k].name != name) ++k;
  if (k == function_count && k + 1 < kFunctionsMax) functions[function_count++].name = name;
  return &functions[k].instructions;
}

static void count_block(qemu_plugin_id_t id, struct qemu_plugin_tb* block) {
  const size_t count = qemu_plugin_tb_n_insns(block);
  (void)id;
  qemu_plugin_register_vcpu_tb_exec_inline(block, kAddToCounter, &instructions, count);
  if (by_function) qemu_plugin_register_vcpu_tb_exec_inline(block, kAddToCounter, counter_of(block), count);
}

static void write_functions(void) {
  char line[kNameMax];
  for (size_t k = 0; k < function_count; ++k) {
    const uint64_t since = functions[k].instructions - functions[k].before;
    functions[k].before = functions[k].instructions;
    if (since == 0) continue;
    snprintf(line, sizeof line, "%.480s %" PRIu64 "\n", functions[k].name ? functions[k].name : "?", since);
    qemu_plugin_outs(line);
  }
}

static void write_at_mark(qemu_plugin_id_t id, unsigned cpu, int64_t number, uint64_t a1, uint64_t a2, uint64_t a3,
                          uint64_t a4, uint64_t a5, uint64_t a6, uint64_t a7, uint64_t a8) {
  char line[32];
  (void)id, (void)cpu, (void)a1, (void)a2, (void)a3, (void)a4, (void)a5, (void)a6, (void)a7, (void)a8;
  if (number != kGetppidOnAArch64) return;
  if (by_function) write_functions();
  snprintf(line, sizeof line, "%" PRIu64 "\n", instructions);
  qemu_plugin_outs(line);
}

EXPORTED int qemu_plugin_install(qemu_plugin_id_t id, const void* info, int argc, char** argv) {
  (void)info;
  by_function = argc > 0 && strcmp(argv[0], "functions=on") == 0;
  qemu_plugin_register_vcpu_tb_trans_cb(id, count_block);
  qemu_plugin_register_vcpu_syscall_cb(id, write_at_mark);
  return 0;
}
