// This build found no three.js: its pages have no view in three dimensions, and say so.
