// SPDX-License-Identifier: MIT
// What a person sees and does in the viewer's picture: cameras, lights, comparisons, views, lens and picking.
#include <functional>
#include <set>

#include "view/viewer_fixture.h"

namespace {

using namespace izb::test;
using izb::Image8;

struct Picture : ViewerTest {};

TEST_F(Picture, OpensAndRests) {
  const json opened = viewer->last("opened");
  EXPECT_EQ(opened["window"], json({480, 300}));
  EXPECT_EQ(opened["framebuffer"], json({480, 300}));
  EXPECT_NE(opened["renderer"].get<std::string>().find("llvmpipe"), std::string::npos);
  EXPECT_TRUE(opened["slow"].get<bool>());
  const json its_scene = viewer->last("scene");
  EXPECT_EQ(its_scene["triangles"], 2 * (2 + 81));
  EXPECT_NE(its_scene["file"].get<std::string>().find("posts.glb"), std::string::npos);
  const json picture = viewer->last("picture");
  ASSERT_EQ(picture["sides"].size(), 1u);
  EXPECT_EQ(picture["sides"][0]["name"], "A");
  EXPECT_EQ(picture["sides"][0]["technique"], "izb");
  EXPECT_EQ(picture["sides"][0]["spp"], 32);
  EXPECT_EQ(picture["sides"][0]["error"], "");
  EXPECT_EQ(picture["sides"][0]["mask_hash"].get<std::string>().size(), 64u);
  const Image8 shown = viewer->still_capture();
  EXPECT_FALSE(is_flat(shown, middle_of(shown)));
  EXPECT_GT(viewer->wait_for("memory")["bytes"].get<double>(), 1e6);
}

TEST_F(Picture, OrbitingIsCoarseAndThenRests) {
  const json camera = camera_of(viewer->state());
  const Image8 before = viewer->still_capture();
  viewer->input().drag({200, 150}, {300, 180}, Button::left, 40);
  viewer->wait_at_rest();
  EXPECT_NE(camera_of(viewer->state()), camera);
  bool coarse = false;
  for (const json& p : viewer->since_input("picture"))
    coarse |= p["motion"].get<bool>() && p["scale"].get<double>() < 1.0;
  EXPECT_TRUE(coarse);
  EXPECT_GT(changed(before, viewer->still_capture(), middle_of(before)), 1000u);
  viewer->input().key("Home");
  viewer->wait_at_rest();
  EXPECT_EQ(camera_of(viewer->state()), camera);
  EXPECT_EQ(changed(before, viewer->still_capture(), middle_of(before)), 0u);
}

TEST_F(Picture, EveryMoveOfTheMouseMovesTheCamera) {
  const std::function<void(XDisplay&)> moves[] = {[](XDisplay& x) {
                                                    x.drag(centre, {280, 170}, Button::right);
                                                  },
                                                  [](XDisplay& x) {
                                                    x.drag(centre, {280, 170}, Button::middle);
                                                  },
                                                  [](XDisplay& x) {
                                                    x.key_down("shift"), x.drag(centre, {280, 170}), x.key_up("shift");
                                                  },
                                                  [](XDisplay& x) { x.scroll(2); },
                                                  [](XDisplay& x) { x.scroll(-2); },
                                                  [](XDisplay& x) {
                                                    x.button_down(Button::right), x.key_down("w"), sleep_s(0.5),
                                                        x.key_up("w"), x.button_up(Button::right);
                                                  },
                                                  [](XDisplay& x) {
                                                    x.double_click({180, 190});
                                                  },
                                                  [](XDisplay& x) { x.key("n"); }};
  int n = 0;
  for (const auto& move : moves) {
    const json before = viewer->state();
    move(viewer->input());
    viewer->wait_at_rest();
    EXPECT_NE(viewer->state(), before) << "move " << n;
    ++n;
  }
}

TEST_F(Picture, LAndDragTurnTheLight) {
  const json lights = lights_of(viewer->state()), camera = camera_of(viewer->state());
  const Image8 before = viewer->still_capture();
  XDisplay& x = viewer->input();
  x.key_down("l");
  x.drag({200, 150}, {280, 190}, Button::left, 20);
  x.key_up("l");
  viewer->wait_at_rest();
  EXPECT_NE(lights_of(viewer->state()), lights);
  EXPECT_EQ(camera_of(viewer->state()), camera);
  EXPECT_GT(changed(before, viewer->still_capture(), middle_of(before)), 100u);
}

TEST_F(Picture, OneTogglesTheSamples) {
  const std::string hash = viewer->last("picture")["sides"][0]["mask_hash"];
  viewer->input().key("1");
  EXPECT_NE(viewer->wait_for("picture", rests_with_spp(1))["sides"][0]["mask_hash"], hash);
  viewer->input().key("1");
  EXPECT_EQ(viewer->wait_for("picture", rests_with_spp(32))["sides"][0]["mask_hash"], hash);
}

TEST_F(Picture, PresetsAndTechniquesFollowOneAnother) {
  json before = viewer->state();
  viewer->input().key("p");
  viewer->wait_for("state", [&](const json& s) { return s["state"] != before; });
  for (const char* technique : {"ray_traced", "shadow_map", "izb"}) {
    viewer->input().key("t");
    viewer->wait_for("picture", shows_technique(technique));
  }
}

TEST_F(Picture, VWalksThroughAllViews) {
  const Image8 picture = viewer->still_capture();
  const std::string first = view_of(viewer->state());
  std::set<std::string> seen{first};
  for (std::string view = first;;) {
    viewer->input().key("v");
    const json line = viewer->wait_for("state", [&](const json& s) { return view_of(s["state"]) != view; });
    view = view_of(line["state"]);
    if (view == first) break;
    ASSERT_TRUE(seen.insert(view).second) << view << " comes again before " << first;
    // It is shown when what it shows has been read back.
    const auto is_shown = [&] {
      const Image8 shown = display->capture();
      return changed(picture, shown, middle_of(picture)) > 0 && !is_flat(shown, middle_of(shown));
    };
    EXPECT_TRUE(wait_until(15.0, is_shown)) << view << " is flat, or the picture";
  }
  EXPECT_GE(seen.size(), 6u) << "one for each stage";
  EXPECT_TRUE(wait_until(15.0, [&] { return changed(picture, display->capture(), middle_of(picture)) == 0; }));
  viewer->input().key("shift+v");
  viewer->wait_for("state", [&](const json& s) { return view_of(s["state"]) != first; });
  viewer->input().key("v");
  viewer->wait_for("state", [&](const json& s) { return view_of(s["state"]) == first; });
}

TEST_F(Picture, TheSplitsBarMoves) {
  split_32_and_1();
  const Image8 before = viewer->still_capture();
  viewer->input().drag(centre, {120, 150}, Button::left, 20);
  // Between the bar's places the other side is seen now; away from them nothing changed, once what a drag shows is
  // gone.
  constexpr int margin = 12;
  Image8 after = viewer->still_capture();
  wait_until(15.0, [&] {
    after = viewer->still_capture();
    return changed(before, after, {240 + margin, 60, 460, 240}) == 0;
  });
  EXPECT_GT(changed(before, after, {120 + margin, 60, 240 - margin, 240}), 20u);
  EXPECT_EQ(changed(before, after, {240 + margin, 60, 460, 240}), 0u);
  EXPECT_EQ(changed(before, after, {20, 60, 120 - margin, 240}), 0u);
}

TEST_F(Picture, FlickerShowsOneSideAfterTheOther) {
  split_32_and_1();
  compare("flicker");
  viewer->input();
  const Image8 first = display->capture();
  const auto differs = [&] { return changed(first, display->capture(), middle_of(first)) > 20; };
  EXPECT_TRUE(wait_until(15.0, differs));
  EXPECT_TRUE(wait_until(15.0, [&] { return !differs(); }));
}

TEST_F(Picture, TheDifferenceIsWhereTheSidesDiffer) {
  const Image8 picture = viewer->still_capture();
  split_32_and_1();
  compare("difference");
  const Image8 shown = viewer->still_capture();
  EXPECT_GT(changed(picture, shown, middle_of(shown)), 1000u);
  EXPECT_FALSE(is_flat(shown, middle_of(shown)));
}

TEST_F(Picture, RComparesWithTheTruth) {
  const Image8 picture = viewer->still_capture();
  viewer->input().key("r");
  viewer->wait_for("picture", [](const json& p) {
    return at_rest(p) && p["sides"].size() == 2 && p["sides"][1]["technique"] == "truth";
  });
  compare("difference");
  const Image8 shown = viewer->still_capture();
  EXPECT_GT(changed(picture, shown, middle_of(shown)), 1000u);
  viewer->input().key("r");
  viewer->wait_for("picture", [](const json& p) {
    return at_rest(p) && p["sides"].size() == 2 && p["sides"][1]["technique"] == "izb";
  });
}

TEST_F(Picture, TheLensMagnifiesAroundThePointer) {
  const Image8 before = viewer->still_capture();
  viewer->input().key("z");
  display->move({241, 150});
  display->move(centre);
  const auto shown = [&] { return magnification(before, display->capture(), centre); };
  ASSERT_TRUE(wait_until(15.0, [&] { return shown() > 1; }));
  const int first = shown();
  const json camera = camera_of(viewer->state());
  viewer->input().scroll(first < 16 ? 1 : -1);
  EXPECT_TRUE(wait_until(15.0, [&] { return shown() != first; }));
  EXPECT_EQ(camera_of(viewer->state()), camera);
  const Image8 after = display->capture();
  EXPECT_EQ(changed(before, after, {20, 240, 80, 290}), 0u) << "far from the pointer it changes nothing";
  viewer->input().key("z");
  EXPECT_TRUE(wait_until(15.0, [&] { return shown() == 1; }));
}

TEST_F(Picture, AClickPicks) {
  size_t in_lists = 0, in_shadow = 0;
  for (int n = 0; n < 40 && (in_lists < 4 || in_shadow == 0); ++n) {
    const Point at{30 + 37 * n % 150, 30 + 53 * n % 240};  // the window of what was picked opens at the right
    viewer->input().click(at);
    // The picture that brings the lists may say the pick before once more.
    const json picked = viewer->wait_for("picked", [&](const json& line) { return line["px"] == json({at.x, at.y}); });
    in_lists += !picked["texels"].empty();
    in_shadow += picked["mask"] != 0 && !picked["occluders"].empty();
  }
  EXPECT_GT(in_lists, 3u);
  EXPECT_GT(in_shadow, 0u);
}

TEST_F(Picture, WhatWasPickedIsLookedAtAgainInTheNextPicture) {
  viewer->input().click({60, 200});
  viewer->wait_for("picked");
  viewer->wait_at_rest();
  XDisplay& x = viewer->input();
  x.key_down("l");
  x.drag({100, 150}, {130, 160}, Button::left, 10);
  x.key_up("l");
  viewer->wait_at_rest();
  EXPECT_EQ(viewer->last("picked")["px"], json({60, 200}));
  EXPECT_FALSE(viewer->since_input("picked").empty());
}

TEST_F(Picture, ADoubleClickFocusesAndPicksNothing) {
  viewer->input().double_click({60, 200});
  viewer->wait_at_rest();
  EXPECT_TRUE(viewer->since_input("picked").empty());
  EXPECT_TRUE(viewer->state()["picked"].is_null());
}

TEST_F(Picture, FrozenListsStayWhileTheCameraMoves) {
  const json before = viewer->state();
  viewer->input().key("g");
  viewer->wait_for("state", [&](const json& s) { return s["state"] != before; });
  viewer->input().drag({200, 150}, {230, 160}, Button::left, 20);
  viewer->wait_at_rest();
  EXPECT_NE(camera_of(viewer->state()), camera_of(before));
  viewer->input().key("g");
  viewer->wait_at_rest();
  EXPECT_EQ(viewer->last("picture")["sides"][0]["error"], "");
}

TEST_F(Picture, WhatATechniqueLacksIsSaidInItsPlace) {
  viewer->stop();
  viewer = open({"--raster", "hw"});
  const json lacking = viewer->last("picture")["sides"][0];
  EXPECT_NE(lacking["error"].get<std::string>().find("cannot run"), std::string::npos) << lacking;
  viewer->input().key("p");  // the defaults
  EXPECT_TRUE(viewer->wait_for("picture", rests_with_spp(32))["sides"][0].contains("mask_hash"));
  viewer->stop();  // with its message about the preset, which the next case would see go
  viewer = nullptr;
}

TEST_F(Picture, HelpAndPanelsComeAndGo) {
  const Image8 picture = viewer->still_capture();
  const std::pair<const char*, const char*> keys[] = {{"F1", "Escape"}, {"F1", "F1"}, {"Tab", "Tab"}};
  for (const auto& [opens, closes] : keys) {
    viewer->input().key(opens);
    const Rect everything{0, 0, 480, 300};
    EXPECT_TRUE(wait_until(15.0, [&] { return changed(picture, display->capture(), everything) > 1000; })) << opens;
    viewer->input().key(closes);
    EXPECT_TRUE(wait_until(15.0, [&] { return changed(picture, display->capture(), middle_of(picture)) == 0; }))
        << closes;
  }
}

}  // namespace
