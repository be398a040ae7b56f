#version 450 core
// 5.5 Nothing to write: the query counts the fragment.

void main() {}
