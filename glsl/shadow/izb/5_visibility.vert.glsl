#version 450 core
// 5.5 Spawning triangle visibility tests: vertices to view space, where the test takes place.
#include "shared/bindings.h"
#include "shared/camera.h"

layout(std430, binding = BIND_INSTANCES) readonly buffer InstanceBlock { InstanceFrame instances[]; };

layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_INSTANCE) in uint instance_index;

layout(location = 0) out vec3 v_position_vs;
layout(location = 1) flat out uint v_instance;

void main() {
  v_position_vs = view_from_object(instances[instance_index], position);
  v_instance = instance_index;
}
