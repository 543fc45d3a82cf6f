// The cloth's surface at the edges of tears (fray.vert).
#define FRAYED
#include "cloth.frag"
