// Texture coordinates of a triangle by its number, beside geometry.glsl.
layout(binding = UNIT_UVS) uniform samplerBuffer vertex_uvs;

vec2 uv_at(InstanceFrame instance, uint corner) {
  return texelFetch(vertex_uvs, int(index_at(corner) + instance.info.w)).xy;
}

vec2[3] triangle_uvs(uint instance, uint triangle) {
  InstanceFrame frame = instances[instance];
  uint first = frame.info.z + triangle * 3u;
  return vec2[3](uv_at(frame, first), uv_at(frame, first + 1u), uv_at(frame, first + 2u));
}
