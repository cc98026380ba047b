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

void set_ray(RTCRay& to, const glm::vec3& origin, const glm::vec3& direction, float from, float end) {
  to = {};
  to.org_x = origin.x, to.org_y = origin.y, to.org_z = origin.z;
  to.dir_x = direction.x, to.dir_y = direction.y, to.dir_z = direction.z;
  to.tnear = from;
  to.tfar = end;
  to.mask = ~0u;
}

template <class Value>
Value between(const std::vector<Value>& values, const std::array<std::uint32_t, 3>& corner, float u, float v) {
  return (1 - u - v) * values[corner[0]] + u * values[corner[1]] + v * values[corner[2]];
}

void fill(const PlacedMesh& placed, const RTCHit& hit, const Ray& ray, Surface& surface) {
  const std::array<std::uint32_t, 3>& corner = placed.mesh->triangles[hit.primID];
  surface.material = &placed.mesh->material;
  surface.position = ray.origin + surface.depth * ray.direction;
  surface.facet_normal = glm::normalize(glm::vec3(hit.Ng_x, hit.Ng_y, hit.Ng_z));
  if (glm::dot(surface.facet_normal, ray.direction) > 0) surface.facet_normal = -surface.facet_normal;
  surface.normal = surface.facet_normal;
  if (!placed.normals.empty()) {
    const glm::vec3 normal = between(placed.normals, corner, hit.u, hit.v);
    const float length = glm::length(normal);
    if (length > 1e-6f) surface.normal = normal / length;
    if (glm::dot(surface.normal, surface.facet_normal) < 0) surface.normal = -surface.normal;
  }
  const Mesh& mesh = *placed.mesh;
  surface.uv = mesh.uvs.empty() ? glm::vec2(0) : between(mesh.uvs, corner, hit.u, hit.v);
  surface.colour = mesh.colours.empty() ? glm::vec3(1) : between(mesh.colours, corner, hit.u, hit.v);
  surface.openness = placed.openness.empty() ? 1 : between(placed.openness, corner, hit.u, hit.v);
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
  low_ = glm::vec3(std::numeric_limits<float>::max());
  high_ = -low_;
  for (const PlacedMesh& mesh : meshes_) {
    attach(device_.get(), scene_, mesh);
    for (const glm::vec3& p : mesh.positions) {
      low_ = glm::min(low_, p);
      high_ = glm::max(high_, p);
    }
  }
  const glm::vec3 margin = 1e-4f * (high_ - low_ + glm::abs(low_) + glm::abs(high_));
  low_ -= margin;
  high_ += margin;
  // One thread, because the tree decides which of two triangles a ray on their common edge meets.
  tbb::task_arena(1).execute([&] { rtcCommitScene(scene_); });
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
    rtcReleaseScene(scene_);
    throw Error(ErrorCode::usage, "render: the scene does not fit into memory");
  }
}

// Spares most rays the call where few things move. Comparisons with NaN (origin on the box's plane, direction along it)
// are false, and leave the interval as it is.
bool Intersector::misses(const glm::vec3& origin, const glm::vec3& direction, float to) const noexcept {
  if (meshes_.empty()) return true;
  float enter = 0, leave = to;
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1 / direction[axis];
    float first = (low_[axis] - origin[axis]) * inverse, last = (high_[axis] - origin[axis]) * inverse;
    if (inverse < 0) std::swap(first, last);
    if (first > enter) enter = first;
    if (last < leave) leave = last;
  }
  return !(enter <= leave);
}

Intersector::~Intersector() { rtcReleaseScene(scene_); }

bool Intersector::nearest(const Ray& ray, float from, float to, Surface& surface) const {
  if (misses(ray.origin, ray.direction, to)) return false;
  RTCRayHit query;
  set_ray(query.ray, ray.origin, ray.direction, from, to);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  surface.depth = query.ray.tfar;
  fill(meshes_[query.hit.geomID], query.hit, ray, surface);
  return true;
}

bool Intersector::blocked(const glm::vec3& origin, const glm::vec3& direction, float to) const {
  if (misses(origin, direction, to)) return false;
  RTCRay query;
  set_ray(query, origin, direction, 0, to);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_, &context, &query);
  return query.tfar < 0;
}

}  // namespace pullfocus::sequences
