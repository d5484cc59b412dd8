// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/survey/surface_shape.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <limits>

#include "lab/sim/middle_of.hpp"
#include "lab/survey/survey_file.hpp"

namespace pose_wall::tools {
namespace {

// Numbers of single precision are 1 mm apart up to here.
constexpr float kFarthest_m = 10000.0F;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw SurveyError(fmt::format("{}: {}", file.string(), why));
}

Eigen::Vector3f vector_of(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

bool has_y_up(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".gltf" || ending == ".glb";
}

// Takes in the meshes of a scene's nodes, each where its node puts it.
class Collector {
 public:
  Collector(const aiScene& scene, std::filesystem::path file) : scene_(scene), file_(std::move(file)) {
    // glTF 2.0, section 3.4: +Y up, +Z forward.
    if (has_y_up(file_)) up_ = Eigen::AngleAxisf(0.5F * static_cast<float>(M_PI), Eigen::Vector3f::UnitX());
  }

  SurfaceShape collect() {
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) has_faces_ = has_faces_ || scene_.mMeshes[i]->HasFaces();
    take_node(*scene_.mRootNode, aiMatrix4x4());
    return std::move(shape_);
  }

 private:
  void take_node(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 to_scene = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) take_mesh(*scene_.mMeshes[node.mMeshes[i]], to_scene);
    for (unsigned i = 0; i < node.mNumChildren; ++i) take_node(*node.mChildren[i], to_scene);
  }

  void take_mesh(const aiMesh& mesh, const aiMatrix4x4& to_scene) {
    if (has_faces_ && (mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return;  // lines and points beside it
    const auto first = static_cast<std::uint32_t>(shape_.points.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const Eigen::Vector3f p = up_ * vector_of(to_scene * mesh.mVertices[i]);
      if (!(p.array().abs() < kFarthest_m).all()) {
        refuse(file_,
               fmt::format("vertex {} is further than {} m from the origin, or no number; there single precision has "
                           "steps above 1 mm. Subtract an offset from the surface and from its path",
                           first + i, static_cast<int>(kFarthest_m)));
      }
      shape_.points.push_back(p);
    }
    if (!has_faces_) return take_normals(mesh, to_scene);
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;
      shape_.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
  }

  void take_normals(const aiMesh& mesh, const aiMatrix4x4& to_scene) {
    if (!mesh.HasNormals()) {
      refuse(file_,
             "it holds points without faces and without normals. A mesh needs faces, a cloud a normal for each point "
             "(nx, ny, nz)");
    }
    const aiMatrix3x3 turn(to_scene);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const Eigen::Vector3f n = up_ * vector_of(turn * mesh.mNormals[i]);
      const float length = n.norm();
      if (!(length > 0.5F)) refuse(file_, fmt::format("point {} has a normal of length {}; 1 is needed", i, length));
      shape_.normals.push_back(n / length);
    }
  }

  const aiScene& scene_;
  const std::filesystem::path file_;
  Eigen::Quaternionf up_ = Eigen::Quaternionf::Identity();
  bool has_faces_ = false;
  SurfaceShape shape_;
};

void refuse_wild_faces(const aiScene& scene, const std::filesystem::path& file) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      const auto is_wild = [&](unsigned k) { return k >= mesh.mNumVertices; };
      if (std::none_of(face.mIndices, face.mIndices + face.mNumIndices, is_wild)) continue;
      refuse(file, fmt::format("face {} names a vertex that is not there; there are {}", i, mesh.mNumVertices));
    }
  }
}

}  // namespace

SurfaceShape read_surface_shape(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) refuse(file, "there is no such file");
  if (!std::filesystem::is_regular_file(file)) refuse(file, "it is no file");
  Assimp::Importer importer;
  const auto demand_read = [&](const aiScene* scene) {
    if (scene != nullptr && scene->mRootNode != nullptr) return;
    refuse(file, fmt::format("it cannot be read as PLY, OBJ or glTF: {}", importer.GetErrorString()));
  };
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  demand_read(scene);
  refuse_wild_faces(*scene, file);  // what cuts polygons into triangles trusts them
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType);
  demand_read(scene);
  SurfaceShape shape = Collector(*scene, file).collect();
  if (shape.points.empty() || (shape.is_cloud() && shape.normals.empty())) refuse(file, "it holds no surface");
  return shape;
}

double spacing_m(const std::vector<Eigen::Vector3f>& points) {
  constexpr std::size_t kLooks = 200;  // at 200,000 points a fifth of a second
  std::vector<float> nearest;
  for (std::size_t i = 0; i < points.size(); i += points.size() / kLooks + 1) {
    float best = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const float d2 = (points[k] - points[i]).squaredNorm();
      if (k != i && d2 > 0.0F && d2 < best) best = d2;
    }
    nearest.push_back(best);
  }
  return std::sqrt(static_cast<double>(sim::middle_of(&nearest)));
}

}  // namespace pose_wall::tools
