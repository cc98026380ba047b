#include "render/intersector.h"

#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "image/error.h"

namespace pullfocus::sequences {
namespace {

void attach(RTCDevice device, RTCScene scene, const PlacedMesh& placed) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t vertices = placed.positions.size(), triangles = placed.mesh->triangles.size();
  if (vertices > 0 && triangles > 0) {
    void* to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, vertices);
    if (to) std::memcpy(to, placed.positions.data(), 12 * vertices);
    to = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles);
    if (to) std::memcpy(to, placed.mesh->triangles.data(), 12 * triangles);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

void set_ray(RTCRay16& to, std::size_t i, const glm::vec3& origin, const glm::vec3& direction, float from, float end) {
  to.org_x[i] = origin.x, to.org_y[i] = origin.y, to.org_z[i] = origin.z;
  to.dir_x[i] = direction.x, to.dir_y[i] = direction.y, to.dir_z[i] = direction.z;
  to.tnear[i] = from;
  to.tfar[i] = end;
  to.time[i] = 0;
  to.mask[i] = ~0u;
  to.id[i] = 0;
  to.flags[i] = 0;
}

template <class Value>
Value between(const std::vector<Value>& values, const std::array<std::uint32_t, 3>& corner, float u, float v) {
  return (1 - u - v) * values[corner[0]] + u * values[corner[1]] + v * values[corner[2]];
}

void fill(const PlacedMesh& placed, const RTCHit16& hits, std::size_t i, const Ray& ray, Surface& surface) {
  const std::array<std::uint32_t, 3>& corner = placed.mesh->triangles[hits.primID[i]];
  const float u = hits.u[i], v = hits.v[i];
  surface.material = &placed.mesh->material;
  surface.position = ray.origin + surface.depth * ray.direction;
  surface.facet_normal = glm::normalize(glm::vec3(hits.Ng_x[i], hits.Ng_y[i], hits.Ng_z[i]));
  if (glm::dot(surface.facet_normal, ray.direction) > 0) surface.facet_normal = -surface.facet_normal;
  surface.normal = surface.facet_normal;
  if (!placed.normals.empty()) {
    const glm::vec3 normal = between(placed.normals, corner, u, v);
    const float length = glm::length(normal);
    if (length > 1e-6f) surface.normal = normal / length;
    if (glm::dot(surface.normal, surface.facet_normal) < 0) surface.normal = -surface.normal;
  }
  const Mesh& mesh = *placed.mesh;
  surface.uv = mesh.uvs.empty() ? glm::vec2(0) : between(mesh.uvs, corner, u, v);
  surface.colour = mesh.colours.empty() ? glm::vec3(1) : between(mesh.colours, corner, u, v);
  surface.openness = placed.openness.empty() ? 1 : between(placed.openness, corner, u, v);
}

}  // namespace

PlacedMesh::PlacedMesh(const Mesh& from, const glm::mat4& world) : mesh(&from) {
  const glm::mat3 linear(world);
  const float volume = glm::determinant(linear);
  const glm::mat3 turned = std::abs(volume) > 0 ? glm::transpose(glm::inverse(linear)) : linear;
  for (const glm::vec3& p : from.positions) positions.emplace_back(world * glm::vec4(p, 1));
  for (const glm::vec3& n : from.normals) {
    const glm::vec3 normal = turned * n;
    const float length = glm::length(normal);
    normals.push_back(length > 0 && std::isfinite(length) ? normal / length : glm::vec3(0, 1, 0));
  }
}

Device make_device() {
  Device device(rtcNewDevice(nullptr), [](RTCDevice d) {
    if (d) rtcReleaseDevice(d);
  });
  if (!device) throw Error(ErrorCode::usage, "render: Embree does not run on this processor");
  return device;
}

Intersector::Intersector(const Device& device, std::vector<PlacedMesh> meshes)
    : device_(device), meshes_(std::move(meshes)), scene_(rtcNewScene(device.get())) {
  // Without robust intersection rays along edges miss.
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  for (const PlacedMesh& mesh : meshes_) {
    attach(device_.get(), scene_, mesh);
    for (const glm::vec3& p : mesh.positions) box_.add(p);
  }
  box_ = box_.with_margin();
  // One thread, because the tree decides which of two triangles a ray on their common edge meets.
  tbb::task_arena(1).execute([&] { rtcCommitScene(scene_); });
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
    rtcReleaseScene(scene_);
    throw Error(ErrorCode::usage, "render: the scene does not fit into memory");
  }
}

Intersector::~Intersector() { rtcReleaseScene(scene_); }

void Intersector::nearest(std::span<const Ray> rays, const Mask& mask, float from, std::span<Surface> surfaces) const {
  RTCRayHit16 query;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    set_ray(query.ray, i, rays[i].origin, rays[i].direction, from, surfaces[i].depth);
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect16(mask.lanes.data(), scene_, &context, &query);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (mask.lanes[i] == 0 || query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    surfaces[i].depth = query.ray.tfar[i];
    fill(meshes_[query.hit.geomID[i]], query.hit, i, rays[i], surfaces[i]);
  }
}

void Intersector::blocked(std::span<const ShadowRay> rays, Mask& mask) const {
  RTCRay16 query;
  for (std::size_t i = 0; i < rays.size(); ++i) set_ray(query, i, rays[i].origin, rays[i].direction, 0, rays[i].to);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(mask.lanes.data(), scene_, &context, &query);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (query.tfar[i] < 0) mask.lanes[i] = 0;
}

}  // namespace pullfocus::sequences
