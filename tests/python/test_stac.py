import json
import os.path

import pytest

import sigmascape


def linked(path, relation):
    """The files that a document links, by one relation."""
    with open(path, encoding="utf-8") as file:
        document = json.load(file)
    return [os.path.normpath(os.path.join(os.path.dirname(path), link["href"])) for link in document["links"] if link["rel"] == relation]


def browsed(root):
    """Every item that a browser of STAC comes to that starts at a collection, as often as it does."""
    items, open_catalogs = [], [(root, root)]
    while open_catalogs:
        catalog, collection = open_catalogs.pop()
        assert linked(catalog, "root") == [root]
        there = {relation: [file for file in linked(catalog, relation) if os.path.exists(file)] for relation in ("child", "item")}
        for file in there["child"] + there["item"]:
            assert linked(file, "parent") == [catalog]
        for item in there["item"]:
            assert linked(item, "collection") == [collection] and json.load(open(item))["type"] == "Feature"
        items += there["item"]
        open_catalogs += [(child, child if os.path.basename(child) == "collection.json" else collection) for child in there["child"]]
    return sorted(items)


def items_of(atlas):
    """Those that lie there, the ground's among them."""
    folders = [f"{store}{level}" for store in ("", "ground/") for level in ("patch_*", "pyramid_*/patch_*")]
    documents = [str(file) for folder in folders for file in atlas.glob(f"{folder}/*.json")]
    return sorted([str(atlas / "terrain.json")] + [file for file in documents if os.path.basename(file) != "catalog.json"])


@pytest.fixture(scope="module")
def shares(tmp_path_factory):
    """The folder of an atlas, and what bakes one of two shares of it."""
    folder = tmp_path_factory.mktemp("stac")
    scene = sigmascape.Scene.simple(side_m=300.0)
    return folder, lambda shard: sigmascape.bake(scene, folder, azimuths=2, elevations_deg=[30.0], texel_m=0.5, patch_texels=256, samples=2,
                                                 shard=shard, progress=False)


def test_a_browser_comes_to_each_item_once_while_baking_and_after(shares):
    folder, bake = shares
    patches = 16
    for shard, looks in (("0/2", patches), ("1/2", 2 * patches)):
        bake(shard)
        found = browsed(str(folder / "collection.json"))
        assert found == items_of(folder)
        assert len([file for file in found if "/patch_" in file and "/az" in file and "pyramid" not in file and "/ground/" not in file]) == looks
    assert len(list(folder.glob("pyramid_1/*/catalog.json"))) == 4
    assert any("/ground/" in file for file in found)


def test_the_collection_links_the_coarsest_level_alone(shares):
    folder, bake = shares
    bake("0/2")
    collection = str(folder / "collection.json")
    assert linked(collection, "item") == [str(folder / "terrain.json")]
    assert linked(collection, "child") == [str(folder / "pyramid_1" / place / "catalog.json")
                                           for place in ("patch_-002_+000", "patch_+000_+000", "patch_-002_-002", "patch_+000_-002")] + [
        str(folder / "ground" / "collection.json")]
