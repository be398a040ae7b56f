#version 450 core
// 5.4 All layers in one draw. With a framebuffer for each, llvmpipe keeps as many frames in flight, and what they drew to and
// read alive for as long as nothing else takes as many: hundreds of megabytes after a lamp with cascades.
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(location = 0) flat in int v_layer[];

void main() {
  for (int i = 0; i < 3; ++i) {
    gl_Layer = v_layer[0];
    gl_Position = gl_in[i].gl_Position;
    EmitVertex();
  }
}
