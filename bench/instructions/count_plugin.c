/* SPDX-License-Identifier: BSD-3-Clause
 * Copyright (c) 2026 the pose_wall authors
 *
 * A plugin for qemu-user (7.2): counts the guest's instructions and writes the count at every getppid(), which the
 * guest calls as a mark. The same to the instruction over runs and machines, where times are not.
 *
 * Debian does not ship qemu-plugin.h. What is used of it is declared here, after "QEMU TCG Plugins" in QEMU's developer
 * documentation, plugin API version 1.
 */

#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>

#define EXPORTED __attribute__((visibility("default")))

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb; /* a block of translated instructions */

typedef void (*block_callback)(qemu_plugin_id_t, struct qemu_plugin_tb*);
typedef void (*call_callback)(qemu_plugin_id_t, unsigned cpu, int64_t number, uint64_t, uint64_t, uint64_t, uint64_t,
                              uint64_t, uint64_t, uint64_t, uint64_t);

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, block_callback callback);
void qemu_plugin_register_vcpu_syscall_cb(qemu_plugin_id_t id, call_callback callback);
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb* block, int operation, void* counter, uint64_t by);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* block);
void qemu_plugin_outs(const char* text);

enum { kAddToCounter = 0, kGetppidOnAArch64 = 173 };

EXPORTED int qemu_plugin_version = 1;
EXPORTED int qemu_plugin_install(qemu_plugin_id_t id, const void* info, int argc, char** argv);

static uint64_t instructions;

static void count_block(qemu_plugin_id_t id, struct qemu_plugin_tb* block) {
  (void)id;
  qemu_plugin_register_vcpu_tb_exec_inline(block, kAddToCounter, &instructions, qemu_plugin_tb_n_insns(block));
}

static void write_at_mark(qemu_plugin_id_t id, unsigned cpu, int64_t number, uint64_t a1, uint64_t a2, uint64_t a3,
                          uint64_t a4, uint64_t a5, uint64_t a6, uint64_t a7, uint64_t a8) {
  char line[32];
  (void)id, (void)cpu, (void)a1, (void)a2, (void)a3, (void)a4, (void)a5, (void)a6, (void)a7, (void)a8;
  if (number != kGetppidOnAArch64) return;
  snprintf(line, sizeof line, "%" PRIu64 "\n", instructions);
  qemu_plugin_outs(line);
}

EXPORTED int qemu_plugin_install(qemu_plugin_id_t id, const void* info, int argc, char** argv) {
  (void)info, (void)argc, (void)argv;
  qemu_plugin_register_vcpu_tb_trans_cb(id, count_block);
  qemu_plugin_register_vcpu_syscall_cb(id, write_at_mark);
  return 0;
}
