#!/usr/bin/env python3
"""Makes all scenes and their textures anew, in the folder above this one: run it after changing a file here."""
import os

import branches
import desk
import gallery
import night
import textures

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
os.makedirs("textures", exist_ok=True)
textures.write_all()
for scene in (desk, branches, night, gallery):
    scene.build()
