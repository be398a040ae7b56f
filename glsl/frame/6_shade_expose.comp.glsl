#version 450 core
// 5.6 The exposure under which the mean of the measured light is 1, which is what a sun alone brings.
#include "shared/bindings.h"
#include "shared/shade.h"

layout(local_size_x = meter_side) in;

layout(std430, binding = BIND_METER) readonly buffer MeterBlock { float brought[]; };
layout(std430, binding = BIND_EXPOSED) writeonly buffer ExposedBlock { Exposure exposure; };

shared float sums[meter_side];
shared int counts[meter_side];

// Sums in one order, so that the picture is the same in every run.
void main() {
  int column = int(gl_LocalInvocationID.x);
  float sum = 0.0;
  int count = 0;
  for (int row = 0; row < meter_side; ++row) {
    float light = brought[row * meter_side + column];
    sum += light;
    count += light > 0.0 ? 1 : 0;
  }
  sums[column] = sum;
  counts[column] = count;
  barrier();
  if (column != 0) return;
  for (int i = 1; i < meter_side; ++i) {
    sum += sums[i];
    count += counts[i];
  }
  exposure.scale = vec4(sum > 0.0 ? float(count) / sum : 1.0);
}
