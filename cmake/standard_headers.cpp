// Holds no code: the headers that nearly every file of the rooms reads are precompiled with it.
