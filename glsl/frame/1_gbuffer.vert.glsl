#version 450 core
// 5.1 Eye-space z-prepass and G-buffer.
#include "shared/bindings.h"
#include "shared/gbuffer.h"

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std430, binding = BIND_INSTANCES) readonly buffer InstanceBlock { InstanceFrame instances[]; };
layout(std430, binding = BIND_MATERIALS) readonly buffer MaterialBlock { MaterialFrame materials[]; };

layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_NORMAL) in vec3 normal;
layout(location = ATTRIBUTE_UV) in vec2 uv;
layout(location = ATTRIBUTE_INSTANCE) in uint instance_index;

layout(location = 0) out vec3 v_normal_vs;
layout(location = 1) out vec2 v_uv;
layout(location = 2) flat out uint v_instance;
layout(location = 3) flat out vec3 v_base_color;

void main() {
  InstanceFrame instance = instances[instance_index];
  gl_Position = camera.clip_from_view * vec4(view_from_object(instance, position), 1.0);
  // Cofactors turn normals right also under non-uniform and mirroring scales, up to a sign that shading settles.
  vec3 x = instance.row_x.xyz, y = instance.row_y.xyz, z = instance.row_z.xyz;
  v_normal_vs = vec3(dot(cross(y, z), normal), dot(cross(z, x), normal), dot(cross(x, y), normal));
  // Here and not in the fragment shader: lanes that only help with derivatives read 0 from buffers there.
  MaterialFrame material = materials[instance.info.y];
  vec3 uv1 = vec3(uv, 1.0);
  v_uv = vec2(dot(material.uv_u.xyz, uv1), dot(material.uv_v.xyz, uv1));
  v_base_color = material.base_color.rgb;
  v_instance = instance_index;
}
