// SPDX-License-Identifier: MIT
#include "view/snapshot.h"
