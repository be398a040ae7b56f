// SPDX-License-Identifier: MIT
// Where each resource is bound, once for GLSL and C++.
#ifndef IZB_SHARED_BINDINGS_H
#define IZB_SHARED_BINDINGS_H

// Uniform blocks.
#define BIND_CAMERA 0
#define BIND_LIGHT 1
#define BIND_SHADE 2
#define BIND_SAMPLES 3
#define BIND_WINDOWS 4
#define BIND_CASCADE_ENDS 5
#define BIND_EXPOSURE 6

// Storage blocks.
#define BIND_INSTANCES 0
#define BIND_POSITIONS 1
#define BIND_INDICES 2
#define BIND_MATERIALS 3
#define BIND_BOUNDS 4
#define BIND_WINDOW 5
#define BIND_COUNTERS 6
#define BIND_PAIRS 7
#define BIND_CASCADES 8
#define BIND_POOL 9
#define BIND_METER 10
#define BIND_EXPOSED 11
#define BIND_LISTED 12
#define BIND_LISTED_COUNTS 13
#define BIND_ASKED 14
// Further windows of positions and indices, one number each, where a driver's storage blocks are too small for the scene.
#define MAX_GEOMETRY_WINDOWS 6
#define BIND_MORE_POSITIONS 16
#define BIND_MORE_INDICES 21
// Of the deformation, which runs before all others: any that it leaves bound is bound anew.
#define BIND_REST_POSITIONS 0
#define BIND_REST_NORMALS 1
#define BIND_TARGETS 2
#define BIND_INFLUENCES 3
#define BIND_JOINTS 4
#define BIND_MORPH_WEIGHTS 5
#define BIND_DEFORMED_POSITIONS 6
#define BIND_DEFORMED_NORMALS 7

// Texture units.
#define UNIT_BASE_COLOR 0
#define UNIT_ID 1
#define UNIT_EYE_DISTANCE 2
#define UNIT_NORMAL 3
#define UNIT_SHADING_NORMAL 4
#define UNIT_ALBEDO 5
#define UNIT_HEADS 6
#define UNIT_NODES 7
#define UNIT_FURTHEST 8
#define UNIT_TESTS 8
#define UNIT_MASK 9
#define UNIT_PYRAMID 10
#define UNIT_OCCLUDERS 10
#define UNIT_MICRO_QUAD 11
#define UNIT_TABLE 12
#define UNIT_ALPHA 13
#define UNIT_UVS 14
#define UNIT_DEPTH_MAP 15

// Image units.
#define IMAGE_EYE_DISTANCE 0
#define IMAGE_NORMAL 1
#define IMAGE_HEADS 2
#define IMAGE_NODES 3
#define IMAGE_FURTHEST 4
#define IMAGE_MASK 5
#define IMAGE_PICTURE 6
#define IMAGE_PYRAMID 7
#define IMAGE_MICRO_QUAD 2
#define IMAGE_WORK 0

// Vertex attributes.
#define ATTRIBUTE_POSITION 0
#define ATTRIBUTE_NORMAL 1
#define ATTRIBUTE_UV 2
#define ATTRIBUTE_INSTANCE 3

#endif
