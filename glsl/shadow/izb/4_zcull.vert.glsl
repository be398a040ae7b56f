#version 450 core
// 5.4 Light-space culling prepass: one triangle over the whole grid of each layer.
layout(location = 0) flat out int v_layer;

void main() {
  v_layer = gl_InstanceID;
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
