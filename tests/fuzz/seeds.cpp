// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Writes inputs to begin with, one folder per target. usage: pose_wall_fuzz_seeds FOLDER

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "fuzz/road_from_input.hpp"
#include "fuzz/seed_planar.hpp"
#include "fuzz/seed_recordings.hpp"
#include "support/runtime_under_test.hpp"

namespace {

using pose_wall::test::require;
using Text = std::string;

std::filesystem::path g_folder;

void write(const char* target, const Text& bytes) {
  static int number = 0;
  const std::filesystem::path folder = g_folder / target;
  std::filesystem::create_directories(folder);
  std::ofstream out(folder / ("seed_" + std::to_string(++number)), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  require(out.good(), "a seed is written");
}

template <typename Value>
Text raw(const Value& value) {
  return Text(reinterpret_cast<const char*>(&value), sizeof value);
}

Text chance(std::uint64_t seed, std::size_t count) {
  Text bytes;
  while (bytes.size() < count) bytes += raw(scramble(seed += 0x51));
  return bytes.substr(0, count);
}

Text floats(std::initializer_list<float> values) {
  Text bytes;
  for (const float value : values) bytes += raw(value);
  return bytes;
}

Text field(char offset, char type) {
  return {offset, type};
}

void frames() {
  const Text layout = Text("\0", 1) + raw<std::uint16_t>(5000) + Text("\0\x0b", 2) + raw<std::uint16_t>(0) +
                      raw<std::int64_t>(1000000000) + field(0, 7) + field(4, 7) + field(8, 7) + field(0, 0);
  write("frame", "\x06" + layout + Text("\x10\x01\x7f", 3));
  write("frame", "\x02" + layout);
  write("frame", "\x0e" + layout);
  write("frame", Text("\0", 1) + layout + floats({1, 2, 3, -1, 2.5F, -1.4F}));
  pose_wall_cloud cloud;
  pose_wall_cloud_xyz32(&cloud, nullptr, 0, 12, 7);
  write("frame", "\x01" + raw(cloud));
}

// Roads of any kind, one after the other, each with what may befall it.
void sequences() {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Text bytes(1, static_cast<char>(seed % 5));
    bytes += chance(seed, 2 * (seed % 5));
    for (std::uint64_t event = 0; event < 4; ++event) {
      bytes += static_cast<char>((seed + event * (seed % 7)) % 8);
      bytes += '\0';  // the next frame's stamp
      bytes += chance(seed * 16 + event, 24);
    }
    write("sequence", bytes);
  }
  // A middling road, three times, handed over in between, then silence.
  Text road(Text("\0", 1) + "\x60\x60\x60\x80\x60\x80\x10");
  road += Text("\0", 1);
  const Text frame = Text("\0\0", 2) + road;
  write("sequence", Text("\0", 1) + frame + frame + Text("\6\0", 2) + frame + Text("\5\0\4\0", 4));
}

// Drives along roads of any kind, with what may befall a frame.
void motions() {
  const Text rough("\x01\x60\x60\xff\x80\x60\x80\x40\x18");  // with bumps, a step of 5 cm
  const Text begin = Text("\0\0", 2) + rough + Text("\0", 1), on("\1\0\0", 3), empty("\6\0\0", 3), again("\5\0\0", 3);
  const Text plain("\0\0", 2);  // config and settings
  write("motion", plain + begin + on + on + on + on + on + on);
  write("motion", plain + begin + on + empty + on + again + on + Text("\7\0", 2));
  write("motion", plain + empty + begin + on + Text("\1\xe0", 2) + raw<std::int64_t>(INT64_MIN) + Text("\0", 1) + on);
  write("motion", plain + begin + Text("\1\0\2\3\0\3\4\2", 8) + on + Text("\1\0\1\7\x90\x20\x90\x20", 8) + on);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Text bytes = Text(1, static_cast<char>(seed % 4)) + chance(seed, 2 * (seed % 4) + 5);
    for (std::uint64_t event = 0; event < 6; ++event) {
      bytes += static_cast<char>((seed * 3 + event) % 7);
      bytes += '\0';
      bytes += chance(seed * 32 + event, 14);
    }
    write("motion", bytes);
  }
}

void mementos() {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) write("memento", Text(1, char(seed % 2)) + chance(seed, 12));
  write("memento", Text("\x02", 1) + chance(3, 512));
}

void runtimes() {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) write("runtime", chance(seed * 7, 60));
}

void images() {
  write("image", Text(2000, '\0'));
  write("image", Text("\x02", 1) + chance(5, 2000));
  write("image", Text("\x01", 1) + chance(6, 240));
}

void configs() {
  const std::uint32_t rows = pose_wall_config_key_count();
  for (std::uint32_t row = 0; row < rows; row += 3) {
    pose_wall_key_info key;
    pose_wall_config_key(row, &key);
    write("config", Text("\0", 1) + static_cast<char>(row) + key.default_text);
  }
  for (const char* value :
       {"-2.3 2.3 -0.6 0.6 -1.5 0.4", "[1, 2, 3, 4, 5, 6]", "1e-3", "-.5E+1", "0x10", "nan", "1e999"}) {
    write("config", Text("\0", 1) + static_cast<char>(18) + value);
  }
  write("config", Text("\4\5", 2) + raw(0.5) + Text("\6\x20\0", 3) + raw(-1.0));
  write("config", Text("\0", 1) + static_cast<char>(rows) + Text("no_such_key\0val", 15));
}

struct Disk {
  Text bytes;
  static std::int32_t write(void* self, std::uint64_t offset, const void* from, std::uint64_t count) {
    Text& bytes = static_cast<Disk*>(self)->bytes;
    if (bytes.size() < offset + count) bytes.resize(offset + count);
    std::memcpy(&bytes[offset], from, count);
    return 0;
  }
};

Text recorded(std::uint32_t clouds) {
  using namespace pose_wall::test;
  Disk disk;
  RuntimeUnderTest runtime([&](pose_wall_runtime_options* o) {
    o->sink = Disk::write;
    o->sink_user = &disk;
    o->box_bytes = 4U << 20U;
    o->box_clouds = clouds;
  });
  runtime.start();
  pose_wall_inputs inputs{};
  inputs.struct_size = sizeof inputs;
  inputs.given = POSE_WALL_INPUT_STANDING;
  for (std::size_t i = 0; i < 2; ++i) {
    const Points points(i * 40, {1, 2, 3});
    pose_wall_cloud cloud = cloud_of(points, static_cast<std::int64_t>(i) * 100 * kMs);
    cloud.inputs = i == 1 ? &inputs : nullptr;
    require(pose_wall_runtime_push(runtime.get(), &cloud) == POSE_WALL_OK, "a frame is taken");
    runtime.wait_idle();
  }
  runtime.pass(400 * kMs);
  runtime.stop();
  return disk.bytes;
}

void boxes() {
  for (const char* target : {"box", "box_file"}) {
    for (const char mended : {'\0', '\x1f', '\x0d'}) write(target, Text(1, mended) + recorded(1));
    write(target, Text(1, '\0') + recorded(0));
  }
}

Text pcd(const Text& types, const Text& encoding, const Text& body) {
  return "# .PCD\nVERSION 0.7\nFIELDS x y z intensity\n" + types + "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n" +
         "POINTS 2\nDATA " + encoding + "\n" + body;
}

void readers() {
  const Text four = "SIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n";
  const Text points = floats({1, 2, 3, 0.5F, -1, 2.5F, -1.4F, 0.25F});
  write("pcd", pcd(four, "ascii", "1 2 3 0.5\n-1 2.5 nan 1e40\r\n"));
  write("pcd", pcd(four, "binary", points));
  write("pcd", pcd("SIZE 8 8 8 2\nTYPE F F F U\nCOUNT 1 1 1 1\n", "binary", chance(1, 52)));
  // LZF: one run of 32 literals.
  write("pcd", pcd(four, "binary_compressed", raw<std::uint32_t>(33) + raw<std::uint32_t>(32) + "\x1f" + points));
  const Text head =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty uchar intensity\n";
  const Text face = "element face 1\nproperty list uchar int vertex_indices\n";
  write("ply", "ply\nformat ascii 1.0\ncomment c\n" + head + face + "end_header\n1 2 3 4\n5 6 7 8\n3 0 1 0\n");
  write("ply", "ply\nformat binary_little_endian 1.0\n" + head + "end_header\n" + chance(2, 26));
  write("ply",
        "ply\nformat binary_big_endian 1.0\n" + face + head + "end_header\n" + Text("\1\0\0\0\0", 5) + chance(3, 26));
  write("kitti", points);
  write("kitti", "");
  write("kitti", points + points.substr(0, 7));
}

void recordings() {
  using namespace pose_wall::test::seeds;
  write("bag", ros1_bag());
  write("bag", mcap());
  write("capture", capture(velodyne_payload()));
  write("capture", ouster_metadata() + capture(Text(32 + 16 * 12 + 2 * 16 * 4 + 32, '\1')));
}

void packets() {
  using namespace pose_wall::test::seeds;
  const Text automatic("\0\x63", 2);
  for (const char product : {'\x22', '\x24', '\x21', '\x28', '\0'}) {
    Text payload = velodyne_payload();
    payload.back() = product;
    write("packets", automatic + datagrams(payload, 2));
  }
  write("packets", automatic + datagrams(hesai_payload(32, 8), 2));
  write("packets", automatic + datagrams(hesai_payload(40, 10), 2));
  write("packets", automatic + datagrams(hesai_payload(64, 4), 2));
  write("packets", automatic + datagrams(mid360_payload('\1', 14), 3));
  write("packets", automatic + datagrams(mid360_payload('\2', 8), 3));
  write("packets", automatic + datagrams(mid360_payload('\3', 10), 3));
  write("packets", automatic + datagrams(mid360_payload('\x11', 28), 3));
  // By the names of a HAP and an Avia 2; and of a data type that is not read.
  for (const char kind : {'\x1C', '\x1D'})
    write("packets", kind + Text("\x63", 1) + datagrams(mid360_payload('\x11', 28), 3));
  write("packets", automatic + datagrams(mid360_payload('\x12', 42), 2));
  const Text first_kind = datagrams(lslidar_payload(Text("\1\2\3\0\x37\x10", 6)), 6);
  write("packets", automatic + datagrams(lslidar_device(), 1) + first_kind);
  write("packets", automatic + first_kind + datagrams(lslidar_device(), 1));
  for (const char model : {'\x10', '\x12', '\x20', '\x64', '\x65', '\x46', '\x5A', '\x08'}) {
    write("packets", automatic + datagrams(lslidar_payload(Text(10, '\1') + '\x39' + model), 6));
  }
  write("packets", Text("\x11\0", 2) + datagrams(lslidar_device(), 1) + datagrams(lslidar_hybrid_payload(), 6));
  for (char kind = 1; kind < 10; ++kind) write("packets", kind + Text("\0", 1) + datagrams(mid360_payload('\2', 8), 1));
  // By metadata: profiles of 4, 8, 12 and 16 bytes a pixel, the other head, a window.
  const Text standard = Text("\1\0\7\0", 4) + Text(28, '\0'), fusa = Text("\1\5\0\0\7\0\0\0", 8) + Text(24, '\0');
  struct OusterSeed {
    int choice;
    Text head;
    std::size_t pixel_bytes;
  };
  const std::vector<OusterSeed> ousters = {{7, standard, 4},  {8, standard, 8},  {1, standard, 12},
                                           {2, standard, 16}, {7 + 16, fusa, 4}, {11 + 16 + 32, fusa, 8}};
  for (const auto& [choice, head, pixel_bytes] : ousters) {
    Text payload = head;
    for (char column = 0; column < 4; ++column) {
      payload += Text(8, '\1') + column + Text("\0\1\0", 3) + Text(2 * pixel_bytes, '\x25');
    }
    write("packets", Text(1, '\5') + static_cast<char>(choice) + datagrams(payload + Text(32, '\0'), 3));
  }
  for (const bool cdr : {false, true}) {
    const char form = cdr ? '\1' : '\0';
    write("message", Text(1, '\0') + form + point_cloud2(cdr));
    write("message", Text(1, '\1') + form + livox_custom(cdr));
    write("message", Text(1, '\2') + form + packet_message(velodyne_payload(), cdr, false, false));
    write("message", Text(1, '\3') + form + packet_message("some packet.", cdr, true, false));
    write("message", Text(1, '\4') + form + packet_message(hesai_payload(40, 10), cdr, false, true));
  }
  write("bag", mcap("velodyne_msgs/msg/VelodyneScan", packet_message(velodyne_payload(), true, false, false)));
  write("bag", mcap("livox_ros_driver2/msg/CustomMsg", livox_custom(true)));
  write("hesai_angles", "Laser id,Elevation,Azimuth\n1,15.0,-1.042\n2,0,3.1\r\n3,-25,0\n");
  write("hesai_angles", "Channel,Elevation,Azimuth\n3,1,1\n3,1,1\n");
}

void texts() {
  write("config_file",
        "# comment\nforward_axis: \"-X\"\nbody_box_1: [-2.3, 2.3, -0.6, 0.6, -1.5, 0.4]\nrange_max: 40\n");
  write("config_file", "s_front: -3.0\ns_back: +2.0\nno_such_key: 1\nrange_min: 1e9\nrange_min: 2\n");
  write("config_file", "a: &x [1, 2]\nb: *x\n---\nc: {d: |\n  e}\n");
  write("config_file", "lidar_frame: 'a name'\nbase_frame: >-\n  folded\n  text\n? forward_axis\n: +X\n");
  write("csv", "frame,stamp_ns,roll,pitch,yaw,d_lf,d_lb,d_rf,d_rb\n0,100,0.1,,-1e-3,2,3,nan,4\n");
  write("csv", "# a comment\n\na,\"b \"\"c\"\"\",\"d\ne\"\r\n1,2,3\n\"\n\",,x\n");
}

void plain_points() {
  write("text_points", "# x y z intensity\n2\n1 2 3 0.5\n-1;2.5;nan;1e40\r\n");
  write("text_points", "\xEF\xBB\xBF\"X\",\"Y\",\"Z\",time\n1,2,3,0.01\n\n// c\n4,5,6,0.02");
}

// Drives, clouds and routes that make use of every byte; then what the planar library saves.
void planar() {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Text drive("\x60\x40\x40", 3);
    drive += static_cast<char>(seed);
    for (std::uint64_t event = 0; event < 10; ++event) {
      drive += static_cast<char>(seed % 3 == 0 ? event % 8 : event == 6 ? 6 : 0);  // a map in the middle
      drive += Text("\0\x40", 2);                                                  // the next stamp, beams
      drive += chance(seed * 64 + event, 2) + "\x10";                              // way and turn, with odometry
    }
    write("planar_scans", drive);
    Text clouds(3, '\0');  // config, scanner and settings
    for (std::uint64_t event = 0; event < 6; ++event) {
      clouds += static_cast<char>((seed * 3 + event) % 8);
      clouds += '\0';
      clouds += chance(seed * 32 + event, 20);
    }
    write("planar_clouds", clouds);
    // A route on a free grid with a few blocks, and the tracker's steps along it.
    Text route("\1\xff\xff\xff\x20", 5);
    route += Text("\x60\x60\x20\x20\x10\x20\0\x20\x80\xff\xff\x80\x80", 13) + static_cast<char>(seed % 8);
    route += chance(seed, 1 + 4 * (seed % 3)) + Text("\0\x20\x20\x80\0\xd0\xd0\x80", 8) + chance(seed + 99, 80);
    write("route", route);
  }
  using namespace pose_wall::test::seeds;
  for (const char mended : {'\0', '\4'}) {
    write("planar_saved", mended + saved_trail());
    write("planar_saved", static_cast<char>(mended + 1) + saved_map(false));
    write("planar_saved", static_cast<char>(mended + 2) + saved_map(true));
  }
  for (const Text& log : carmen_logs()) write("carmen_log", log);
  for (const Text& image : pgm_images()) write("pgm", image);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  g_folder = argv[1];
  frames();
  sequences();
  motions();
  mementos();
  runtimes();
  images();
  configs();
  boxes();
  readers();
  recordings();
  texts();
  packets();
  plain_points();
  planar();
  return 0;
}
