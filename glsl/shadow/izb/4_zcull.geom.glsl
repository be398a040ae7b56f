#version 450 core
// 5.4 All layers in one draw. With a framebuffer for each, grids that were long deleted stayed allocated on llvmpipe, hundreds of
// megabytes after a lamp with cascades; its queue of frames in flight seems to hold them until it is as long again.
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
