// The edges of a footprint, within which none of the four is negative at a texel's centre; three corners give one of them twice.
vec3 footprint_edge(vec3 p, vec3 q, float turn) {
  vec2 n = vec2(p.y - q.y, q.x - p.x) * turn;
  return vec3(n, -dot(n, p.xy));
}

vec3[4] footprint_edges(Footprint f) {
  vec3 last = f.count == 4 ? f.p3 : f.p2;
  vec2 u = f.p1.xy - f.p0.xy, v = f.p2.xy - f.p0.xy;
  float turn = u.x * v.y - u.y * v.x < 0.0 ? -1.0 : 1.0;
  return vec3[4](footprint_edge(f.p0, f.p1, turn), footprint_edge(f.p1, last, turn), footprint_edge(last, f.p2, turn),
                 footprint_edge(f.p2, f.p0, turn));
}
