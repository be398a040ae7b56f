#version 450 core
// 5.6 Final render: Phong shading from the G-buffer, modulated by the visibility mask. Light after light is added.
#include "shared/bindings.h"
#include "shared/light.h"
#include "shared/shade.h"

layout(local_size_x = 16, local_size_y = 16) in;

layout(std140, binding = BIND_CAMERA) uniform CameraBlock { CameraFrame camera; };
layout(std140, binding = BIND_LIGHT) uniform LightBlock { LightFrame light; };
layout(std140, binding = BIND_SHADE) uniform ShadeBlock { ShadeFrame shade; };
layout(std140, binding = BIND_EXPOSURE) uniform ExposureBlock { Exposure exposure; };
layout(binding = UNIT_EYE_DISTANCE) uniform sampler2D eye_distance_texture;
layout(binding = UNIT_NORMAL) uniform sampler2D normal_texture;
layout(binding = UNIT_SHADING_NORMAL) uniform sampler2D shading_normal_texture;
layout(binding = UNIT_ALBEDO) uniform sampler2D albedo_texture;
layout(binding = UNIT_MASK) uniform usampler2D mask_texture;
layout(binding = IMAGE_PICTURE, rgba16f) uniform image2D picture;
layout(location = 0) uniform bool first;  // of the lights: with sky and ambient light

vec3 sky(vec3 direction) {
  float height = dot(direction, shade.up_vs.xyz);
  vec3 above = mix(shade.sky_horizon.rgb, shade.sky_zenith.rgb, sqrt(clamp(height, 0.0, 1.0)));
  return mix(above, shade.ground.rgb, smoothstep(0.0, -0.05, height));
}

vec3 shaded(ivec2 px, float t, vec3 p, vec3 view) {
  vec4 albedo = texelFetch(albedo_texture, px, 0);
  vec3 normal = octahedral_direction(texelFetch(normal_texture, px, 0).xy);
  vec3 shading_normal = normal == vec3(0.0) ? -view : normalize(normal);
  if (albedo.a > 0.75) {
    shading_normal = octahedral_decode(2.0 * texelFetch(shading_normal_texture, px, 0).xy - 1.0);
    if (dot(shading_normal, normal) < 0.0) shading_normal = -shading_normal;
  }
  vec3 color = vec3(0.0);
  if (first) {
    float up = 0.5 + 0.5 * dot(shading_normal, shade.up_vs.xyz);
    color = albedo.rgb * shade.up_vs.w * mix(shade.ground.rgb, shade.sky_zenith.rgb, up);
  }

  // The geometric normal decides whether light arrives at all, as for the IZB (6.5).
  vec3 to_light = is_positional(light) ? normalize(light.origin.xyz - p) : light.to_light.xyz;
  LightFrame culling = light;
  culling.color.w = 1.0;
  if (receiver_class(culling, p, normal) != class_receiver) return color;
  float arriving = arriving_light(light, shade, p) * exposure.scale.x;
  float visibility = 1.0 - float(bitCount(texelFetch(mask_texture, px, 0).x)) * (1.0 / 32.0);
  float diffuse = max(dot(shading_normal, to_light), 0.0);
  vec3 halfway = normalize(to_light - view);
  float specular = diffuse > 0.0 ? 0.04 * pow(max(dot(shading_normal, halfway), 0.0), 32.0) : 0.0;
  return color + light.color.rgb * (arriving * visibility) * (albedo.rgb * diffuse + specular);
}

void main() {
  ivec2 px = ivec2(gl_GlobalInvocationID.xy);
  if (px.x >= int(camera.size_px.x) || px.y >= int(camera.size_px.y)) return;
  float t = texelFetch(eye_distance_texture, px, 0).x;
  vec3 p = receiver_point(camera, vec2(px) + 0.5, t > 0.0 ? t : 1.0);
  vec3 view = is_perspective(camera) ? normalize(p) : vec3(0.0, 0.0, -1.0);
  vec3 color = t > 0.0 ? shaded(px, t, p, view) : first ? sky(view) : vec3(0.0);
  if (!first) color += imageLoad(picture, px).rgb;
  imageStore(picture, px, vec4(min(color, 65000.0), 1.0));  // a lamp at a surface is brighter than half floats go
}
