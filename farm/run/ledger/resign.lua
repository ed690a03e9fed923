-- Ends an owner's lead, if it leads.
--
-- KEYS[1]  leader: the owner that queues the jobs
-- ARGV[1]  owner that resigns
-- Returns  1

if redis.call('GET', KEYS[1]) == ARGV[1] then
    redis.call('DEL', KEYS[1])
end
return 1
